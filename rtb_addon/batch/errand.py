"""
One condition, rendered for a batch that is elsewhere: what a task is on any engine, on any machine.

The one who runs it owns a worker child, so that an abort in native code ends that child alone; the child
stays for the batch's next errand there. All that both sides share is the recipe's folder. The batch keeps
a folder in it; the errand leaves there how far it is, and stops once it cannot, for then nobody waits for
it any more.
"""

from __future__ import annotations

import errno
import json
import os
import socket
import time
from functools import partial
from pathlib import Path

from ..background import Event
from ..worker import Task
from . import idle_workers
from .crew import Crew

PULSE = 0.3  # [s] between two signs of life
_GONE = {errno.ENOENT, errno.ENOTDIR, errno.ESTALE}


def run_errand(words: str, meeting: str) -> str:
    """
    Render one condition and return how that ended; safe to do twice.

    Parameters
    ----------
    words : the task as a line of JSON; the end is an event as such a line
    meeting : the batch's folder, where it looks for news
    """
    task = Task.from_json(words)
    if not Path(task.folder).is_dir():
        lost = f"{socket.gethostname()} sees no {task.folder}, it must lie on a disk that all machines share"
        return Event("failed", condition=task.condition, message=lost, fault="rendering").to_json()
    pulse, waiting = (_Pulse(Path(meeting) / name) for name in (f"{task.condition}.json", ".idle.json"))
    keep = partial(idle_workers.keep, meeting, gone=waiting.unwanted)
    for event in Crew([task], 1, idle_workers.take(meeting), keep).work(pulse.unwanted):
        pulse.news = event
    ended = pulse.news.kind in {"done", "cached", "failed"}
    return (pulse.news if ended else Event("cancelled", condition=task.condition)).to_json()


class _Pulse:
    """Signs of life for the batch; the file system's answer tells whether it still waits."""

    def __init__(self, file: Path) -> None:
        self.news = Event("started")
        self._file, self._due, self._gone = file, 0.0, False

    def unwanted(self) -> bool:
        """Leave a sign of life if one is due; return whether nobody waits for it."""
        if not self._gone and (now := time.monotonic()) >= self._due:
            self._due = now + PULSE
            self._gone = not self._left()
        return self._gone

    def _left(self) -> bool:
        # Only what changes a folder is sure to hear of its end: what a shared disk says of it may be old.
        aside = self._file.with_name(f".{socket.gethostname()}-{os.getpid()}-{self._file.name}")
        try:
            aside.write_text(self.news.to_json(), encoding="utf-8")
            aside.replace(self._file)
        except OSError as error:
            return error.errno not in _GONE
        return True


def news_in(meeting: Path) -> dict[str, Event]:
    """Return the last that errands left in a batch's folder, by condition."""
    found = {}
    for entry in os.scandir(meeting):
        if not entry.name.startswith("."):
            try:
                event = Event.from_json(Path(entry).read_text(encoding="utf-8"))
            except (OSError, json.JSONDecodeError):  # just being replaced
                continue
            found[entry.name.removesuffix(".json")] = event
    return found
