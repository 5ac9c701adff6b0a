"""The workers of a batch: who renders what, and what happens when one dies."""

from __future__ import annotations

import queue
import signal
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress

from ..background import Event, EventStream, close_input, send, start_child, stop_all
from ..worker import Task

GRACE = 0.4  # [s] that workers have to stop
INTERVAL = 0.05  # [s] between two looks at whether somebody wants to stop


class Crew:
    """
    Workers that share a list of tasks.

    A worker that dies has its task tried once more by a new one; then that task has failed and the
    others go on.

    Parameters
    ----------
    tasks : what to render
    size : how many workers at once, at most
    idle : a worker that waits for tasks already, to begin with
    keep : takes a worker that has no more to do; None: it is let go
    """

    def __init__(
        self,
        tasks: Iterable[Task],
        size: int,
        idle: EventStream | None = None,
        keep: Callable[[EventStream], None] | None = None,
    ) -> None:
        self._waiting = deque(tasks)
        self._size = size
        self._idle, self._keep = idle, keep
        self._at_work: dict[EventStream, Task | None] = {}
        self._saving: dict[EventStream, dict[str, Task]] = {}
        self._died: set[str] = set()
        self._inbox: queue.SimpleQueue[tuple[EventStream, Event | None]] = queue.SimpleQueue()

    def work(self, cancelled: Callable[[], bool]) -> Iterator[Event]:
        """Yield what happens until all is done or somebody cancels; then no worker is left."""
        if self._idle is not None:
            self._idle.inbox = self._inbox
        try:
            yield from self._hire()
            while self._at_work and not cancelled():
                with suppress(queue.Empty):
                    yield from self._heard(*self._inbox.get(timeout=INTERVAL))
        finally:
            stop_all([stream.process for stream in self._at_work], GRACE)

    def _hire(self) -> Iterator[Event]:
        while self._waiting and len(self._at_work) < self._size:
            yield from self._give_task(self._idle or self._new_worker())
            self._idle = None

    def _new_worker(self) -> EventStream:
        task = self._waiting[0]
        # Where another renderer was asked for, what the recipe says would only be imported in vain.
        expected = [] if "renderer" in task.overrides else [task.folder]
        return EventStream(start_child(expected, "rtb_addon.worker", task.threads), self._inbox)

    def _give_task(self, worker: EventStream) -> Iterator[Event]:
        """Give a worker its next task, or the evening off once nothing of it is left to be saved."""
        task = self._waiting.popleft() if self._waiting else None
        self._at_work[worker] = task
        if task is None:
            if not self._saving.get(worker):
                self._let_go(worker)
        elif send(worker.process, task.to_json()):  # where it cannot hear, its end will be heard
            yield Event("started", condition=task.condition)

    def _let_go(self, worker: EventStream) -> None:
        if self._keep is None:
            close_input(worker.process)
        else:
            del self._at_work[worker]
            self._keep(worker)

    def _heard(self, worker: EventStream, event: Event | None) -> Iterator[Event]:
        if event is None:
            yield from self._bury(worker)
            yield from self._hire()
            return
        # The next task is given before anybody hears of it, who may take their time.
        given = list(self._next_given(worker, event))
        yield event
        yield from given

    def _next_given(self, worker: EventStream, event: Event) -> Iterator[Event]:
        saving, task = self._saving.setdefault(worker, {}), self._at_work[worker]
        if event.kind == "progress" and event.fraction == 1 and task is not None:
            saving[event.condition] = task
            yield from self._give_task(worker)
        elif event.kind != "progress":
            saved = saving.pop(event.condition, None)
            if saved is None or task is None:
                yield from self._give_task(worker)

    def _bury(self, worker: EventStream) -> Iterator[Event]:
        rendering, saving = self._at_work.pop(worker), list(self._saving.pop(worker, {}).values())
        stop_all([worker.process], GRACE)
        # What it was rendering has killed it; what was only to be saved is innocent, unless it was alone.
        task = rendering or next(iter(saving), None)
        self._waiting.extendleft(each for each in saving if each is not task)
        if task is None:
            return
        how = _cause_of_death(worker)
        if task.condition in self._died:
            message = f"its worker died twice, {how}"
            yield Event("failed", condition=task.condition, message=message, fault="rendering")
        else:
            self._died.add(task.condition)
            self._waiting.appendleft(task)
            message = f"its worker died, {how}; it is tried once more"
            yield Event("progress", condition=task.condition, message=message)


def _cause_of_death(worker: EventStream) -> str:
    """Return how a worker ended and its last words, for one sentence."""
    code = worker.process.returncode
    how = f"killed by {signal.Signals(-code).name}" if code < 0 else f"with exit status {code}"
    if words := worker.last_words().splitlines():
        return f"{how}, saying: {words[-1][:300]}"
    # Nobody else sends this one unasked.
    return f"{how}, perhaps for want of memory" if how.endswith("SIGKILL") else how
