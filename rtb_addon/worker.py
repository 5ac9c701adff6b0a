"""
A child of a batch: renders one condition after the other and keeps what is warm warm.

It reads a task a line from its standard input and writes events to its standard output. It runs
until its input closes, and stops in the middle of a rendering when that happens.
"""

from __future__ import annotations

import dataclasses
import json
import os
import queue
import signal
import sys
import time
import traceback
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TextIO

from .background import Event
from .errors import Cancelled, RecipeError, RenderingError
from .lifeline import stop_for_good, watch_parent

if TYPE_CHECKING:
    from .recipe import Recipe

GRACE = 0.5  # [s] from the wish to stop to the end, whatever native code is doing
INTERVAL = 0.1  # [s] between two events of progress


@dataclass(frozen=True)
class Task:
    """
    What a batch asks of a worker.

    Parameters
    ----------
    folder : of the recipe
    condition : its name
    overrides : options that win over the recipe's
    threads : processor threads to use
    gpu : whether to render on a graphics card
    fresh : whether to render even what is done
    remodeler : code that changes the scene, which somebody trusts: source, file and line of each part
    """

    folder: str
    condition: str
    overrides: dict[str, Any] = field(default_factory=dict)
    threads: int = 1
    gpu: bool = False
    fresh: bool = False
    remodeler: tuple[tuple[str, str, int], ...] = ()

    def to_json(self) -> str:
        """Return the task as one line."""
        return json.dumps(dataclasses.asdict(self))

    @classmethod
    def from_json(cls, line: str) -> Task:
        """Return the task of a line."""
        words = json.loads(line)
        return cls(**{**words, "remodeler": tuple(map(tuple, words["remodeler"]))})


class Desk:
    """Where tasks arrive and events leave."""

    def __init__(self, outgoing: TextIO) -> None:
        self.closed = False
        self._outgoing = outgoing
        self._tasks: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._told = 0.0
        watch_parent(self._tasks.put, self._close, getattr(signal, "SIGKILL", None))

    def next_task(self) -> Task | None:
        """Wait for a task, or for the end."""
        line = self._tasks.get()
        return None if line is None or self.closed else Task.from_json(line)

    def tell(self, event: Event) -> None:
        """Write an event for the batch."""
        self._outgoing.write(event.to_json() + "\n")
        self._outgoing.flush()

    def report(self, fraction: float) -> None:
        """Tell how far a rendering is; raise when the input has closed. Renderers call this."""
        if self.closed:
            raise Cancelled
        if (now := time.monotonic()) - self._told > INTERVAL:
            self._told = now
            self.tell(Event("progress", fraction=fraction))

    def _close(self) -> None:
        self.closed = True
        self._tasks.put(None)
        stop_for_good(GRACE)


def main() -> None:
    """Render what the batch asks for until it asks no more."""
    desk = Desk(own_output())
    recipes: dict[tuple[str, str], Recipe] = {}
    while (task := desk.next_task()) is not None:
        desk.tell(replace(_outcome(task, recipes, desk), condition=task.condition))


def _outcome(task: Task, recipes: dict[tuple[str, str], Recipe], desk: Desk) -> Event:
    """Return how a task ended; nothing that a rendering raises ends the worker."""
    # Only now: a worker listens to its parent before it imports what takes a second.
    from .batch.rendering import render_condition

    try:
        recipe = _recipe_of(task, recipes)
        how = {"threads": task.threads, "gpu": task.gpu, "fresh": task.fresh}
        done = render_condition(recipe, task.condition, desk.report, **how)
    except Cancelled:
        return Event("cancelled")
    except RecipeError as error:
        return Event("failed", message=str(error), fault="recipe")
    except RenderingError as error:
        return Event("failed", message=str(error), fault="rendering")
    except Exception as error:
        message = f"{type(error).__name__}: {error}".replace("\n", " ")
        return Event("failed", message=message, fault="rendering", details=traceback.format_exc())
    return Event(
        "done" if done.new else "cached",
        fraction=1.0,
        file=str(done.file),
        seconds=done.record["seconds"],
        warnings=tuple(done.record["warnings"]),
    )


def _recipe_of(task: Task, recipes: dict[tuple[str, str], Recipe]) -> Recipe:
    """Return a task's recipe, read once: its scenes stay parsed from condition to condition."""
    from .recipe import Recipe
    from .recipe.remodeler import Part, Remodeler

    which = task.folder, json.dumps([task.overrides, task.remodeler], sort_keys=True)
    if which not in recipes:
        parts = tuple(Part(*part) for part in task.remodeler)
        recipe = Recipe.load(task.folder).overridden(**task.overrides)
        recipes[which] = replace(recipe, remodeler=Remodeler(parts) if parts else None)
    return recipes[which]


def own_output() -> TextIO:
    """Keep standard output for events alone; what libraries print goes to standard error."""
    own = os.fdopen(os.dup(sys.stdout.fileno()), "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return own


if __name__ == "__main__":
    try:
        main()
    except BrokenPipeError:  # the batch is gone, and nobody reads what we could say
        os._exit(1)
