"""The child that looks at cubes for Blender, asked and listened to without ever waiting for it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from typing import Any

from ..rtb_addon.background import EventStream, send, start_child, stop

Answer = Mapping[str, Any]
GONE = "the process that looks at renderings has ended"


class ViewerChild:
    """
    ``python -m rtb_addon.viewer``, which answers one request after the other.

    While one is under way, the newest request of each kind waits and the older ones are dropped: somebody who
    moves a slider wants to see where it is now.
    """

    def __init__(self) -> None:
        self._child = start_child([], module="rtb_addon.viewer", threads=1)
        self._stream = EventStream(self._child, parse=json.loads)
        self._waiting: dict[str, tuple[dict[str, Any], Callable[[Answer], None]]] = {}
        self._then: Callable[[Answer], None] | None = None

    @property
    def busy(self) -> bool:
        """Whether an answer is awaited."""
        return self._then is not None

    def ask(self, kind: str, request: dict[str, Any], then: Callable[[Answer], None]) -> None:
        """Let a function have the answer to a request, as soon as there is one."""
        self._waiting[kind] = request, then
        self._send_next()

    def take(self) -> bool:
        """Hand on what has been answered since last time, and return whether there was anything."""
        answers = self._stream.ready()
        for answer in answers:
            then, self._then = self._then, None
            if then is not None:
                then(answer)
        if self._stream.ended and self._then is not None:
            self._give_up(self._then)
            return True
        self._send_next()
        return bool(answers)

    def wait(self, seconds: float = 60.0) -> None:
        """Hand on answers until none is awaited, where there is no window to keep alive."""
        deadline = time.monotonic() + seconds
        while self.busy and time.monotonic() < deadline:
            self.take()
            time.sleep(0.005)

    def stop(self) -> None:
        """End the child; nobody gets an answer any more."""
        self._waiting.clear()
        self._then = None
        stop(self._child, grace=0.2)

    @property
    def ended(self) -> bool:
        """Whether the child has gone."""
        return self._child.poll() is not None

    def _send_next(self) -> None:
        if self.busy or not self._waiting:
            return
        request, then = self._waiting.pop(next(iter(self._waiting)))
        self._then = then
        if not send(self._child, json.dumps(request)):
            self._give_up(then)

    def _give_up(self, then: Callable[[Answer], None]) -> None:
        """Tell whoever waits that nobody answers any more."""
        self._then = None
        self._waiting.clear()
        then({"sentence": GONE})
