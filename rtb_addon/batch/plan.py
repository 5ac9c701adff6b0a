"""What a batch has to do: which conditions are done and which are to be rendered, or what is wrong."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ..background import Event
from ..conditions import Condition
from ..errors import RecipeError, RecipeProblems
from ..recipe import CONDITIONS, Recipe
from ..recipe.foresight import Foresight
from ..recipe.resources import listed
from .keys import key_of
from .rendering import found
from .saving import Rendering


class Plan(NamedTuple):
    """
    What is done and what is to do; keys are left behind, so that a long table takes little memory.

    Parameters
    ----------
    cached : an event for each condition that is done
    waiting : conditions to render
    """

    cached: list[Event]
    waiting: list[Condition]


def plan(
    recipe: Recipe, chosen: Sequence[Condition], fresh: bool, cancelled: Callable[[], bool] = lambda: False
) -> Plan:
    """
    Return what a batch has to do; raise everything that is wrong, before anything is rendered.

    Once cancelled says yes, nothing more is to be done.
    """
    made, problems, foresight = Plan([], []), _Problems(), Foresight(recipe)
    for condition in chosen:
        if cancelled():
            return Plan(made.cached, [])
        try:
            key = key_of(recipe, condition)
        except RecipeError as error:
            problems.add(error)
            continue
        if not fresh and (done := found(recipe, condition, key)) is not None:
            made.cached.append(_cached(done))
        else:
            made.waiting.append(condition)
            for error in foresight.problems_of(condition, key.adjustments):
                problems.add(error, condition.name)
    problems.raise_if_any()
    return made


def chosen_conditions(recipe: Recipe, names: Sequence[str] | None) -> list[Condition]:
    """Return the conditions of some names, in the table's order; all of them for None."""
    if not len(recipe.conditions):
        raise RecipeError("no row below its header, each condition needs one", CONDITIONS)
    asked = {recipe.conditions[name].name for name in names} if names is not None else None
    return [condition for condition in recipe.conditions if asked is None or condition.name in asked]


def up_to_date(recipe: Recipe) -> list[str]:
    """Return the names of those conditions that a batch would find done."""
    there = [each for each in recipe.conditions if recipe.rendering_file(each).is_file()]
    return [each.name for each in there if _is_done(recipe, each)]


def _is_done(recipe: Recipe, condition: Condition) -> bool:
    try:
        return found(recipe, condition, key_of(recipe, condition)) is not None
    except RecipeError:
        return False


class _Problems:
    """Sentences, each once, with the conditions that they hold for."""

    def __init__(self) -> None:
        self._found: dict[str, tuple[RecipeError, list[str]]] = {}

    def add(self, error: RecipeError, *names: str) -> None:
        self._found.setdefault(str(error), (error, []))[1].extend(names)

    def raise_if_any(self) -> None:
        problems = [
            RecipeError(error.message + (f" ({listed(names)})" if names else ""), error.file, error.line)
            for error, names in self._found.values()
        ]
        if problems:
            raise problems[0] if len(problems) == 1 else RecipeProblems(problems)


def _cached(done: Rendering) -> Event:
    warnings = tuple(done.record.get("warnings", ()))
    return Event("cached", condition=done.condition, fraction=1.0, file=str(done.file), warnings=warnings)
