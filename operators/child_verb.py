"""
Verbs of the command line, such as check or pack, in child processes that Blender does not wait for.

They live here and not in Blender's data, so that undo and saving do not touch them.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import NamedTuple

import bpy

from ..rtb_addon.blender.redrawing import redraw_panels
from .preferred import renderer_folders

INTERVAL = 0.1  # [s] between two looks at whether a child has ended

under_way: list[ChildVerb] = []


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
    of_file : whether it speaks of the file that is open, and is not wanted once another one is
    """

    def __init__(self, arguments: list[str], then: Callable[[Ended], None], of_file: bool = False) -> None:
        from ..rtb_addon.background import start_child  # brings subprocess, which enabling need not wait for

        self.verb, self.of_file = arguments[0], of_file
        self.then = then
        self.ended: Ended | None = None
        self._child = start_child(arguments, folders=renderer_folders())
        if bpy.app.background:
            then(self._heard())
            return
        self._thread = threading.Thread(target=self._listen, daemon=True)
        self._thread.start()
        under_way.append(self)
        if not bpy.app.timers.is_registered(_look):
            bpy.app.timers.register(_look, first_interval=INTERVAL, persistent=True)

    def stop(self) -> None:
        """End the child now; nobody is told."""
        from ..rtb_addon.background import stop

        stop(self._child, grace=0.0)
        self._thread.join(timeout=1.0)

    def _listen(self) -> None:
        self.ended = self._heard()

    def _heard(self) -> Ended:
        said, complained = self._child.communicate()
        return Ended(self._child.returncode, said.splitlines(), complained.splitlines())


def is_under_way(verb: str) -> bool:
    """Return whether a verb's child has not ended yet."""
    return any(each.verb == verb for each in under_way)


def stop_all(only_of_file: bool = False) -> None:
    """End the children now, those alone that speak of the open file if that is what goes."""
    for each in list(under_way):
        if each.of_file or not only_of_file:
            under_way.remove(each)
            each.stop()
    if not under_way and bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)


def _look() -> float | None:
    """Tell whom it concerns which children have ended; Blender calls this and goes on."""
    for each in list(under_way):
        if each.ended is not None:
            under_way.remove(each)
            each.then(each.ended)
            redraw_panels()
    return INTERVAL if under_way else None
