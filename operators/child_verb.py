"""A verb of the command line, such as check or pack, in a child process that Blender does not wait for."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import NamedTuple

import bpy

from .preferred import renderer_folders

INTERVAL = 0.1  # [s] between two looks at whether the child has ended


class Ended(NamedTuple):
    """How a child ended: its exit status and the lines that it wrote."""

    status: int
    lines: list[str]
    complaints: list[str]

    def last_words(self, doing: str) -> str:
        """Return the sentence that it ended with."""
        return self.complaints[-1] if self.complaints else f"{doing} ended without a word"


class ChildVerb:
    """
    ``python -m rtb_addon ARGUMENTS`` in a process of its own.

    Parameters
    ----------
    then : is called in Blender's main thread with how it ended; not where it was stopped
    """

    def __init__(self, arguments: list[str], then: Callable[[Ended], None]) -> None:
        from ..rtb_addon.background import start_child  # brings subprocess, which enabling need not wait for

        self._then = then
        self._found: Ended | None = None
        self._stopped = False
        self._child = start_child(arguments, folders=renderer_folders())
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()
        if bpy.app.background:
            self._thread.join()
            self._look()
        else:
            bpy.app.timers.register(self._look, first_interval=INTERVAL, persistent=True)

    def stop(self) -> None:
        """End the child now; nobody is told."""
        from ..rtb_addon.background import stop

        self._stopped = True
        stop(self._child, grace=0.0)
        self._thread.join(timeout=1.0)

    def _listen(self) -> None:
        said, complained = self._child.communicate()
        self._found = Ended(self._child.returncode, said.splitlines(), complained.splitlines())

    def _look(self) -> float | None:
        if self._stopped:
            return None
        if self._found is None:
            return INTERVAL
        self._then(self._found)
        return None
