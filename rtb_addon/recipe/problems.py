"""Everything that is wrong with a recipe, found without rendering."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..consent import has_consent
from ..errors import RecipeError
from .condition_scene import (
    adjustments_of,
    refusals,
    refuse_layers,
    remodeled_parent,
    renderer_of,
    resolve_condition,
)
from .foresight import Foresight
from .remodeler import REMODELER, UNTRUSTED, code_of

if TYPE_CHECKING:
    from ..conditions import Condition
    from . import Recipe


class Finding(NamedTuple):
    """One thing to say about a recipe: a problem, or only a warning."""

    problem: RecipeError | None
    warning: str = ""

    @property
    def is_problem(self) -> bool:
        """Whether nothing can be rendered because of it."""
        return self.problem is not None

    @property
    def sentence(self) -> str:
        """What to say."""
        return str(self.problem or self.warning)


def check_recipe(folder: Path | str) -> list[RecipeError]:
    """Return everything that is wrong with the recipe in a folder, not the first thing only."""
    from . import Recipe

    try:
        recipe = Recipe.load(folder)
    except RecipeError as error:
        return [error]
    return problems(recipe)


def problems(recipe: Recipe) -> list[RecipeError]:
    """Return everything that is wrong, each once."""
    return [finding.problem for finding in findings(recipe) if finding.problem is not None]


def findings(recipe: Recipe) -> list[Finding]:
    """Return everything that is wrong or odd, each once."""
    once = {f.sentence: f for f in _findings(recipe)}
    return list(once.values())


def _findings(recipe: Recipe) -> Iterator[Finding]:
    yield from (Finding(None, sentence) for sentence in recipe.unknown_words())
    try:
        conditions = recipe.conditions
    except RecipeError as error:
        yield Finding(error)
        conditions = ()
        yield from _mapping_problems(recipe)
    else:
        yield from (Finding(None, str(remark)) for remark in conditions.remarks)
    yield from _untrusted(recipe)
    foresight = Foresight(recipe)
    for condition in conditions:
        yield from _condition_findings(recipe, condition, foresight)
    yield from (Finding(None, sentence) for sentence in recipe.resources.warnings)


def _missing(recipe: Recipe, name: str) -> str | None:
    """Return why a renderer is not here, None when it is."""
    installed = recipe.once(("version", name), renderer_of(recipe, name).version)
    return installed.reason if installed.version is None else None


def _mapping_problems(recipe: Recipe) -> Iterator[Finding]:
    try:
        recipe.mappings  # noqa: B018  reading is what raises
    except RecipeError as error:
        yield Finding(error)


def _untrusted(recipe: Recipe) -> Iterator[Finding]:
    """Find fault with a remodeler that may not run; what its scenes would be then nobody can tell."""
    if recipe.remodeler is None and (code := code_of(recipe)) is not None and not has_consent(code):
        yield Finding(RecipeError(UNTRUSTED, REMODELER))


def _condition_findings(recipe: Recipe, condition: Condition, foresight: Foresight) -> Iterator[Finding]:
    try:
        name = recipe.options_of(condition).renderer
        if (reason := _missing(recipe, name)) is not None:
            yield Finding(RecipeError(f"the renderer {name} cannot be used here: {reason}"))
        refuse_layers(renderer_of(recipe, name), recipe.options_of(condition))
        if recipe.remodeler is None and code_of(recipe) is not None:
            adjustments_of(recipe, condition, recipe.find_file)
            return
        parent = remodeled_parent(recipe, condition)
        adjustments = adjustments_of(recipe, condition, recipe.find_file, parent)
        if wrong := foresight.problems_of(condition, adjustments):
            yield from map(Finding, wrong)
            return
        resolved = resolve_condition(recipe, condition, adjustments)
    except RecipeError as error:
        yield Finding(error)
        return
    yield from (Finding(None, sentence) for sentence in resolved.warnings)
    yield from map(Finding, refusals(recipe, condition, resolved))
