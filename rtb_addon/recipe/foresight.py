"""What would fail only while it renders, such as a spectrum that is not there, found before."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..errors import RecipeError
from ..scene.adjustments import Adjustments
from ..scene.declarations import declarations
from ..scene.values import Values
from .condition_scene import adjustments_of, remodeled_parent, resolve_condition
from .named_files import texture_names

if TYPE_CHECKING:
    from ..conditions import Condition
    from . import Recipe


class Foresight:
    """
    Looks ahead for a family of conditions.

    Building a condition's whole scene tells all that is wrong, but a thousand of them take as long as
    many a rendering. So only values are read, and a scene is built only where one of them looks wrong, to
    learn whether anything in it needs that value; what looks wrong in the same way is the same. Only then
    a remodeler that is trusted runs here: it may put right what looks wrong.
    """

    def __init__(self, recipe: Recipe) -> None:
        self._recipe = recipe
        self._judged: dict[tuple[str, ...], bool] = {}

    def problems_of(self, condition: Condition, adjustments: Adjustments) -> list[RecipeError]:
        """Return what is wrong with a condition's values and files."""
        suspected = list(self._suspected(condition, adjustments))
        sentences = tuple(map(str, suspected))
        if self._recipe.remodeler is not None:
            sentences += (condition.name,)  # code may put right in one condition what it leaves in another
        if suspected and sentences not in self._judged:
            self._judged[sentences] = self._fails(condition, adjustments, suspected)
        return suspected if self._judged.get(sentences) else []

    def _suspected(self, condition: Condition, adjustments: Adjustments) -> Iterator[RecipeError]:
        recipe = self._recipe
        for name in texture_names(recipe.parent_file(condition)):
            try:
                if recipe.find_file(name) is None:
                    yield RecipeError(f"there is no texture {name} in the folder or its resources/")
            except RecipeError as error:
                yield error
        values = Values(recipe.find_file)
        try:
            declared = declarations(adjustments.objects, values)
        except RecipeError as error:
            yield error
            return
        for each in declared.values():
            for name, said in each.said.items():
                try:
                    values.read(each.id, each.parameters[name], said)
                except RecipeError as error:
                    yield error

    def _fails(self, condition: Condition, adjustments: Adjustments, suspected: list[RecipeError]) -> bool:
        """Return whether a condition cannot be rendered; the sentence that says so joins the others."""
        recipe = self._recipe
        try:
            if recipe.remodeler is not None:
                parent = remodeled_parent(recipe, condition)
                adjustments = adjustments_of(recipe, condition, recipe.find_file, parent)
            resolve_condition(recipe, condition, adjustments)
        except RecipeError as error:
            if str(error) not in map(str, suspected):
                suspected.append(error)
            return True
        return False
