"""A recipe's conditions become renderings: what is done is found, the rest is shared among workers."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..background import Event
from ..conditions import Condition
from ..errors import RecipeError
from ..files import sweep
from ..recipe import CONDITIONS, Recipe
from ..recipe.locks import locked
from ..recipe.options import section_words
from ..recipe.remodeler import Hook, remodeled
from ..worker import Task
from . import records
from .crew import Crew
from .keys import Key, key_of, versions_of
from .rendering import SCRATCH, Rendering, found, render_condition

_ENDS = {"done", "cached", "failed"}


def render_recipe(
    folder: Path | str,
    *,
    renderer: str | None = None,
    conditions: Sequence[str] | None = None,
    samples: int | None = None,
    size: tuple[int, int] | None = None,
    jobs: int | None = None,
    threads: int = 1,
    fresh: bool = False,
    remodelers: Sequence[Hook] = (),
    trust: bool = False,
    cancelled: Callable[[], bool] = lambda: False,
) -> Iterator[Event]:
    """
    Render the conditions of the recipe in a folder and yield what happens.

    Parameters
    ----------
    renderer, samples, size : win over what conditions and recipe.json say; size is (width, height) [pixels]
    conditions : names of those to render; None: all
    jobs : workers at once; None: one a processor core
    threads : processor threads of each worker; with one, results repeat bit for bit
    fresh : render even what is done
    remodelers : functions before_all, before_condition, after_condition, instead of remodeler.py
    trust : run the folder's remodeler.py even if the user has not agreed to that yet
    cancelled : asked all the time; once it says yes everything stops within a second

    Raises
    ------
    RecipeError
        When the recipe is wrong, before anything is rendered.
    """
    width, height = size or (None, None)
    options = {"renderer": renderer, "samples": samples, "width": width, "height": height}
    recipe = remodeled(Recipe.load(folder).overridden(**options), remodelers, trust)
    chosen = chosen_conditions(recipe, conditions)
    with locked(recipe.folder):
        sweep(recipe.folder)
        batch = _Batch(recipe, total=len(chosen))
        try:
            for event in _events(recipe, chosen, jobs, threads, fresh, cancelled):
                batch.note(stamped := batch.stamped(event))
                yield stamped
        finally:
            with suppress(OSError):  # where another disk holds the cubes, it lies there
                (recipe.folder / SCRATCH).rmdir()


def chosen_conditions(recipe: Recipe, names: Sequence[str] | None) -> list[Condition]:
    """Return the conditions of some names, in the table's order; all of them for None."""
    if not len(recipe.conditions):
        raise RecipeError("no row below its header, each condition needs one", CONDITIONS)
    asked = [recipe.conditions[name].name for name in names] if names is not None else None
    return [condition for condition in recipe.conditions if asked is None or condition.name in asked]


def _events(
    recipe: Recipe,
    chosen: list[Condition],
    jobs: int | None,
    threads: int,
    fresh: bool,
    cancelled: Callable[[], bool],
) -> Iterator[Event]:
    keys = _keys(recipe, chosen)
    yield Event("started", warnings=(*recipe.unknown_words(), *recipe.resources.warnings))
    waiting = []
    for condition in chosen:
        if not fresh and (done := found(recipe, condition, keys[condition.name])) is not None:
            yield _cached(done)
        else:
            waiting.append(condition)
    tasks = [_task(recipe, condition, threads, fresh) for condition in waiting]
    size = min(len(tasks), jobs or max(1, processor_cores() // threads))
    yield from Crew(tasks, size).work(cancelled)
    yield Event("cancelled" if cancelled() else "finished")


def _keys(recipe: Recipe, chosen: list[Condition]) -> dict[str, Key]:
    """Return every condition's key; raise the first problem before anything is rendered."""
    keys, problems = {}, {}
    for condition in chosen:
        try:
            keys[condition.name] = key_of(recipe, condition)
        except RecipeError as error:
            problems.setdefault(str(error), error)
    if problems:
        first, *others = problems.values()
        more = f" (and {len(others)} more, see check)" if others else ""
        raise RecipeError(first.message + more, first.file, first.line) from first
    return keys


def _cached(done: Rendering) -> Event:
    warnings = tuple(done.record.get("warnings", ()))
    return Event("cached", condition=done.condition, fraction=1.0, file=str(done.file), warnings=warnings)


def _task(recipe: Recipe, condition: Condition, threads: int, fresh: bool) -> Task:
    parts = recipe.remodeler.parts if recipe.remodeler else ()
    return Task(str(recipe.folder), condition.name, dict(recipe.overrides), threads, fresh, parts)


def processor_cores() -> int:
    """Return how many processor cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@dataclass
class _Batch:
    """How far a batch is, and its log."""

    recipe: Recipe
    total: int
    finished: int = 0
    _rendered: int = 0
    _fractions: dict[str, float] = field(default_factory=dict)
    _began: float = field(default_factory=time.monotonic)

    def stamped(self, event: Event) -> Event:
        """Return an event with the batch's totals and the expected time to its end."""
        if event.kind in _ENDS:
            self.finished += 1
            self._rendered += event.kind != "cached"
            self._fractions.pop(event.condition, None)
        elif event.condition:
            self._fractions[event.condition] = event.fraction
        renderer = ""
        if event.condition:
            renderer = self.recipe.options_of(self.recipe.conditions[event.condition]).renderer
        return replace(
            event, renderer=renderer, finished=self.finished, total=self.total, remaining=self._remaining()
        )

    def _remaining(self) -> float | None:
        under_way = sum(self._fractions.values())
        work = self._rendered + under_way
        left = self.total - self.finished - under_way
        if left <= 0:
            return 0.0
        return round((time.monotonic() - self._began) * left / work, 1) if work > 0 else None

    def note(self, event: Event) -> None:
        """Write an event of note into the recipe's log."""
        said = {
            name: value
            for name in ("condition", "renderer", "message", "details", "seconds", "file", "warnings")
            if (value := getattr(event, name))
        }
        if event.kind in {"started", "finished", "cancelled"} and not event.condition:
            said |= {"finished": event.finished, "total": event.total, **self._circumstances(event)}
        elif event.kind not in {"done", "failed"} and not event.message:
            return
        records.note(self.recipe.folder, event.kind, **said)

    def _circumstances(self, event: Event) -> dict:
        if event.kind != "started":
            return {}
        name = self.recipe.overrides.get("renderer", self.recipe.options.renderer)
        return {
            "library version": records.library_version(),
            "renderer": name,
            **versions_of(self.recipe, name),
            "options": section_words(self.recipe.options) | dict(self.recipe.overrides),
            "process": os.getpid(),
        }


__all__ = ["chosen_conditions", "render_condition", "render_recipe"]
