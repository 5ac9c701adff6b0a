"""A batch on somebody else's engine: any concurrent.futures.Executor, such as that of a Dask cluster."""

from __future__ import annotations

import queue
import shutil
import time
import uuid
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, Future, wait
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from ..background import Event
from ..errors import RecipeError, RenderingError
from ..worker import Task
from . import idle_workers
from .errand import news_in, run_errand

UNDER_WAY = ".under-way"  # where errands leave signs of life
GRACE = 1.0  # [s] that running errands have to stop
INTERVAL = 0.05  # [s] between two looks at whether somebody wants to stop
_LOOK = 0.25  # [s] between two looks for news


class Errands:
    """
    Tasks that an executor shares out among its own; it does what a Crew does.

    The engine retries what its machines lose. Errands that run when a batch ends early stop by themselves.

    Parameters
    ----------
    tasks : what to render
    executor : the engine; all its machines must see the folder at the same place
    folder : of the recipe
    """

    def __init__(self, tasks: Sequence[Task], executor: Executor, folder: Path) -> None:
        self._tasks, self._executor = tasks, executor
        self._meeting = folder / UNDER_WAY / uuid.uuid4().hex
        self._known: dict[str, Event] = {}
        self._inbox: queue.SimpleQueue[Future[str]] = queue.SimpleQueue()

    def work(self, cancelled: Callable[[], bool]) -> Iterator[Event]:
        """Yield what happens until all is done or somebody cancels; then no errand is left."""
        shutil.rmtree(self._meeting.parent, ignore_errors=True)  # nobody waits for what a killed batch began
        self._meeting.mkdir(parents=True)
        out: dict[Future[str], Task] = {}
        try:
            for task in self._tasks:
                out[self._sent(task)] = task
            look = 0.0
            while out and not cancelled():
                with suppress(queue.Empty):
                    ended = self._inbox.get(timeout=INTERVAL)
                    yield from self._ended(ended, out.pop(ended).condition)
                if (now := time.monotonic()) >= look:
                    look = now + _LOOK
                    yield from self._news({task.condition for task in out.values()})
        finally:
            self._end_meeting()
            wait([future for future in out if not future.cancel()], GRACE)
            idle_workers.dismiss(str(self._meeting))  # of an engine in this process

    def _end_meeting(self) -> None:
        """Take away the folder at one stroke: errands leave signs of life in it while it is emptied."""
        with suppress(OSError):
            self._meeting.rename(self._meeting.with_name("over"))
        shutil.rmtree(self._meeting.parent, ignore_errors=True)

    def _sent(self, task: Task) -> Future[str]:
        try:
            future = self._executor.submit(run_errand, task.to_json(), str(self._meeting))
        except RuntimeError as error:  # it is broken, or was shut down
            raise RenderingError(f"the executor takes no tasks: {error}") from error
        future.add_done_callback(self._inbox.put)
        return future

    def _news(self, out: set[str]) -> Iterator[Event]:
        """Yield what errands left since the last look."""
        for name, event in news_in(self._meeting).items():
            if name in out and self._known.get(name) != event:
                if name not in self._known:
                    yield Event("started", condition=name)
                self._known[name] = event
                if event.kind == "progress":
                    yield replace(event, condition=name)

    def _ended(self, future: Future[str], condition: str) -> Iterator[Event]:
        if condition not in self._known:
            yield Event("started", condition=condition)
        if future.cancelled():
            said = "the engine cancelled it"
        elif (error := future.exception()) is not None:
            said = f"the engine lost it: {type(error).__name__}: {error}".replace("\n", " ")
        else:
            yield Event.from_json(future.result())
            return
        yield Event("failed", condition=condition, message=said, fault="rendering")


@contextmanager
def dask_executor(address: str) -> Iterator[Executor]:
    """Yield the executor of the Dask cluster whose scheduler listens at an address."""
    try:
        from distributed import Client
    except ImportError as error:
        raise RecipeError("a scheduler needs Dask here too, install rtb_addon[dask]") from error
    try:
        client = Client(address, timeout=10, set_as_default=False)
    except (OSError, ValueError, RuntimeError, TypeError) as error:
        words = str(error).partition("\n")[0] or type(error).__name__
        raise RecipeError(f"no Dask scheduler answers at {address}: {words}") from error
    try:
        yield client.get_executor(pure=False)
    finally:
        client.close(timeout=2)
