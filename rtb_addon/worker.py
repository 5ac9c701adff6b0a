"""
A child of a batch: renders one condition after the other and keeps what is warm warm.

It reads a task a line from its standard input and writes events to its standard output. It runs
until its input closes, and stops in the middle of a rendering when that happens. Folders of recipes among its
arguments are those whose tasks it may expect.
"""

from __future__ import annotations

import dataclasses
import json
import os
import queue
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TextIO

from .background import Event
from .errors import Cancelled, RecipeError, RenderingError
from .lifeline import stop_for_good, watch_parent, watch_standstill

if TYPE_CHECKING:
    from .batch.saving import Rendering, Unsaved
    from .recipe import Recipe

GRACE = 0.5  # [s] from the wish to stop to the end, whatever native code is doing
INTERVAL = 0.1  # [s] between two events of progress
BIG = 256 << 20  # [bytes] of a cube that memory should not hold beside the next one


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
        self._lock = threading.Lock()
        watch_parent(self._tasks.put, self._close, getattr(signal, "SIGKILL", None))

    def next_task(self) -> Task | None:
        """Wait for a task, or for the end."""
        line = self._tasks.get()
        return None if line is None or self.closed else Task.from_json(line)

    def tell(self, event: Event) -> None:
        """Write an event for the batch."""
        with self._lock:
            self._outgoing.write(event.to_json() + "\n")
            self._outgoing.flush()

    def report(self, condition: str, fraction: float) -> None:
        """Tell how far a rendering is; raise when the input has closed."""
        if self.closed:
            raise Cancelled
        if (now := time.monotonic()) - self._told > INTERVAL:
            self._told = now
            # All of it is done only where nothing is left but to save it.
            self.tell(Event("progress", condition=condition, fraction=min(fraction, 0.999)))

    def _close(self) -> None:
        self.closed = True
        self._tasks.put(None)
        stop_for_good(GRACE)


def main() -> None:
    """Render what the batch asks for until it asks no more."""
    desk = Desk(own_output())
    # Only now: a worker listens to its parent before it imports what takes a while.
    from .batch import rendering  # noqa: F401

    recipes: dict[tuple[str, str], Recipe] = {}
    for folder in sys.argv[1:]:
        _expect(folder, recipes)
    saver, busy = Saver(desk), threading.Event()
    watch_standstill(busy.is_set)
    while (task := desk.next_task()) is not None:
        busy.set()
        made = attempt(task.condition, partial(_rendered, task, recipes, desk))
        busy.clear()
        desk.tell(made) if isinstance(made, Event) else saver.take(made)
    saver.finish()


def _expect(folder: str, recipes: dict[tuple[str, str], Recipe]) -> None:
    """Read a recipe whose tasks will come, and import its renderer, while the batch still makes its plan."""
    from .batch.keys import key_of

    with suppress(Exception):  # what is wrong with it is said of the task
        recipe = _recipe_of(Task(folder, ""), recipes)
        key_of(recipe, next(iter(recipe.conditions)))


class Saver:
    """
    Saves a rendering in a thread of its own, while the next one is being rendered.

    The batch learns that a rendering is done but for that, as progress of 1, and gives the next task.
    """

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._taken: queue.Queue[Unsaved] = queue.Queue()
        threading.Thread(target=self._save_all, daemon=True).start()

    def take(self, unsaved: Unsaved) -> None:
        """Save a rendering soon, a big one at once; no more than one waits in memory."""
        self.finish()
        if unsaved.image.radiance.nbytes > BIG:
            self._save(unsaved)
            return
        self._desk.tell(Event("progress", condition=unsaved.condition, fraction=1.0))
        self._taken.put(unsaved)

    def finish(self) -> None:
        """Wait until all is saved."""
        self._taken.join()

    def _save_all(self) -> None:
        while True:
            self._save(self._taken.get())
            self._taken.task_done()

    def _save(self, unsaved: Unsaved) -> None:
        self._desk.tell(attempt(unsaved.condition, lambda: _end(unsaved.save())))


def attempt(condition: str, act: Callable[[], Any]) -> Any:
    """Return what an act does, or how it failed; nothing that a rendering raises ends the worker."""
    try:
        return act()
    except Cancelled:
        return Event("cancelled", condition=condition)
    except RecipeError as error:
        return Event("failed", condition=condition, message=str(error), fault="recipe")
    except RenderingError as error:
        return Event("failed", condition=condition, message=str(error), fault="rendering")
    except Exception as error:
        message = f"{type(error).__name__}: {error}".replace("\n", " ")
        details = traceback.format_exc()
        return Event("failed", condition=condition, message=message, fault="rendering", details=details)


def _rendered(task: Task, recipes: dict[tuple[str, str], Recipe], desk: Desk) -> Event | Unsaved:
    from .batch.rendering import rendered
    from .batch.saving import Unsaved

    report = partial(desk.report, task.condition)
    how = {"threads": task.threads, "gpu": task.gpu, "fresh": task.fresh}
    made = rendered(_recipe_of(task, recipes), task.condition, report, **how)
    return made if isinstance(made, Unsaved) else _end(made)


def _end(done: Rendering) -> Event:
    return Event(
        "done" if done.new else "cached",
        condition=done.condition,
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
