"""The child's side of background.py: it never outlives its parent."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable


def watch_parent(
    heard: Callable[[str], None] | None, orphaned: Callable[[], None], last_signal: int | None = None
) -> None:
    """
    Listen to the parent in a thread, for a process that start_child started; do nothing in any other.

    Parameters
    ----------
    heard : called with each line that the parent writes
    orphaned : called once when the parent closed the pipe or died
    last_signal : what the system sends when the parent dies, where it can: even native code obeys
    """
    if (tie := os.environ.pop("RTB_PARENT", None)) is None:
        return
    if tie == "process" and last_signal is not None and sys.platform == "linux":
        _ask_for_signal(last_signal)
    threading.Thread(target=_listen, args=(heard, orphaned), daemon=True).start()


def stop_for_good(grace: float) -> None:
    """End this process after a grace time [s], whatever it is doing."""
    timer = threading.Timer(grace, os._exit, [1])
    timer.daemon = True
    timer.start()


def _listen(heard: Callable[[str], None] | None, orphaned: Callable[[], None]) -> None:
    for line in sys.stdin:
        if heard is not None:
            heard(line)
    orphaned()


def _ask_for_signal(number: int) -> None:
    import ctypes

    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.Signals(number))
