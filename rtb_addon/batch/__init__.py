"""A recipe's conditions become renderings: what is done is found, the rest is shared among workers."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from ..background import Event
from ..conditions import Condition
from ..files import sweep
from ..recipe import Recipe
from ..recipe.locks import locked
from ..recipe.remodeler import Hook, remodeled
from ..worker import Task
from .crew import Crew
from .errands import Errands, dask_executor
from .journal import Journal
from .plan import chosen_conditions, plan, up_to_date
from .rendering import render_condition
from .saving import SCRATCH

__all__ = ["chosen_conditions", "render_condition", "render_recipe", "up_to_date"]


def render_recipe(
    folder: Path | str,
    *,
    renderer: str | None = None,
    conditions: Sequence[str] | None = None,
    samples: int | None = None,
    size: tuple[int, int] | None = None,
    jobs: int | None = None,
    threads: int = 1,
    gpu: bool = False,
    fresh: bool = False,
    remodelers: Sequence[Hook] = (),
    trust: bool = False,
    executor: Executor | None = None,
    scheduler: str | None = None,
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
    gpu : render on a graphics card, if the renderer can
    fresh : render even what is done
    remodelers : functions before_all, before_condition, after_condition, instead of remodeler.py
    trust : run the folder's remodeler.py even if the user has not agreed to that yet
    executor : whose tasks render the conditions, instead of workers of this process
    scheduler : address of a Dask cluster that does; all its machines see the folder at the same place
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
        journal, work = Journal(recipe, len(chosen)), _Work(jobs, threads, gpu, fresh, executor, scheduler)
        try:
            for event in _events(recipe, chosen, work, cancelled):
                journal.note(stamped := journal.stamped(event))
                yield stamped
        finally:
            sweep(recipe.folder / SCRATCH)  # of what workers that died had begun
            with suppress(OSError):  # where another disk holds the cubes, it lies there
                (recipe.folder / SCRATCH).rmdir()


@dataclass(frozen=True)
class _Work:
    """How the conditions of a batch are to be rendered."""

    jobs: int | None
    threads: int
    gpu: bool
    fresh: bool
    executor: Executor | None
    scheduler: str | None

    @contextmanager
    def crew(self, recipe: Recipe, waiting: list[Condition]) -> Iterator[Crew | Errands]:
        """Yield who does it."""
        tasks = [self._task(recipe, condition) for condition in waiting]
        if tasks and self.scheduler is not None:
            with dask_executor(self.scheduler) as executor:
                yield Errands(tasks, executor, recipe.folder)
        elif self.executor is not None:
            yield Errands(tasks, self.executor, recipe.folder)
        else:
            yield Crew(tasks, min(len(tasks), self.jobs or max(1, processor_cores() // self.threads)))

    def _task(self, recipe: Recipe, condition: Condition) -> Task:
        parts = recipe.remodeler.parts if recipe.remodeler else ()
        overrides = dict(recipe.overrides)
        how = (self.threads, self.gpu, self.fresh)
        return Task(str(recipe.folder), condition.name, overrides, *how, parts)


def _events(
    recipe: Recipe, chosen: list[Condition], work: _Work, cancelled: Callable[[], bool]
) -> Iterator[Event]:
    cached, waiting = plan(recipe, chosen, work.fresh, cancelled)
    with work.crew(recipe, waiting) as crew:
        yield Event("started", warnings=(*recipe.unknown_words(), *recipe.resources.warnings))
        yield from cached
        yield from crew.work(cancelled)
    yield Event("cancelled" if cancelled() else "finished")


def processor_cores() -> int:
    """Return how many processor cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
