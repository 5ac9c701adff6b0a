"""A batch that renders in a child process, followed without ever waiting for it."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path

from ..rtb_addon.background import Event, EventStream, start_child, stop
from ..rtb_addon.spreadsheets import format_rows
from .preferred import arguments, renderer_folders

GRACE = 0.5  # [s] that a child has to stop when asked, before it is ended
NICENESS = 5


class ChildBatch:
    """
    A recipe's conditions, rendered by ``python -m rtb_addon render FOLDER --json``.

    Parameters
    ----------
    folder : of the recipe
    conditions : names of those to render; all where there are none
    heard : called with each event's condition, kind and, of one that failed, the reason
    """

    def __init__(
        self,
        folder: Path,
        conditions: Sequence[str] = (),
        heard: Callable[[str, str, str], None] = lambda condition, kind, reason: None,
    ) -> None:
        self.folder = folder
        self._heard = heard
        self.finished = self.total = 0
        self.found = 0  # of the finished ones, those that were done before
        self.remaining: float | None = None
        self.failures: list[str] = []
        self.warnings: list[str] = []
        self.montage: Path | None = None
        self.cancelled = self.ended = False
        self.under_way: dict[str, float] = {}  # how much of each condition is done, 0 to 1
        self._deadline: float | None = None
        # In one word, for a name may begin with a minus; quoted, for it may have commas.
        chosen = ["--conditions=" + format_rows([conditions], ",").strip()] if conditions else []
        self._child = start_child(
            ["render", str(folder), "--json", *chosen, *arguments()], folders=renderer_folders()
        )
        self._events = EventStream(self._child)
        with suppress(
            OSError, AttributeError
        ):  # the interface goes before the renderers, where that can be said
            os.setpriority(os.PRIO_PROCESS, self._child.pid, NICENESS)

    @property
    def progress(self) -> float:
        """How much of the batch is done, 0 to 1; conditions under way count in part."""
        return min((self.finished + sum(self.under_way.values())) / self.total, 1.0) if self.total else 0.0

    def take(self) -> bool:
        """Take in what the child has said since last time, and return whether there was anything new."""
        events = self._events.ready()
        for event in events:
            self._apply(event)
        if self._deadline is not None and time.monotonic() > self._deadline:
            stop(self._child, grace=0.0)
        if self._events.ended and not self.ended and self._child.poll() is not None:
            self.ended = True
            self._explain_the_end(self._child.returncode)
        return bool(events) or self.ended

    def cancel(self) -> None:
        """Ask the child to stop, and return at once; renderings that are done are kept."""
        if self.cancelled or self.ended:
            return
        self.cancelled = True
        self._deadline = time.monotonic() + GRACE
        assert self._child.stdin is not None
        with suppress(OSError):
            self._child.stdin.close()

    def stop(self) -> None:
        """Cancel, and wait until the child is gone; at most a second."""
        self.cancel()
        stop(self._child, GRACE)
        self._deadline = None
        for _ in range(100):  # the reading thread needs a moment
            if self.ended:
                break
            self.take()
            time.sleep(0.01)

    def follow_to_the_end(self) -> None:
        """Take in everything until the child has ended, where there is no interface to keep alive."""
        try:
            while not self.ended:
                self.take()
                time.sleep(0.02)
        finally:
            self.stop()

    def _apply(self, event: Event) -> None:
        self.finished, self.total = event.finished or self.finished, event.total or self.total
        self.remaining = event.remaining
        self.warnings += [text for text in event.warnings if text not in self.warnings]
        if event.kind == "progress":
            self.under_way[event.condition] = event.fraction
        elif event.condition:
            self.under_way.pop(event.condition, None)
        if event.condition:
            self._heard(event.condition, event.kind, event.message)
        self.found += event.kind == "cached"
        if event.kind == "failed":
            self.failures.append(": ".join(filter(None, (event.condition, event.message))))
        if event.kind == "finished" and event.file:
            self.montage = Path(event.file)

    def _explain_the_end(self, code: int) -> None:
        """Leave a sentence when the child ended badly without having said why in an event."""
        if code and not self.failures and not self.cancelled:
            words = self._events.last_words().splitlines()
            self.failures.append(words[-1] if words else f"the rendering process ended with {code}")
