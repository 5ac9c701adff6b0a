"""The child's side of background.py: it never outlives its parent, and never stands still for good."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Callable

STANDSTILL = 300.0  # [s] without work after which a process has hung
STUCK = 75  # exit status of such a process
_LOOK = 1.0  # [s] between two looks
_LEAST = 0.005  # share of its time that a process at work spends on a processor at least


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


def watch_standstill(busy: Callable[[], bool], limit: float = STANDSTILL, look: float = _LOOK) -> None:
    """
    End this process once it has spent no processor time for so long although it is busy.

    However slow a rendering is, it computes; what waits for something that never comes does not.

    Parameters
    ----------
    busy : whether there is something to be done
    limit : how long it may stand still [s]; time that the machine sleeps does not count
    look : time between two looks [s]
    """
    threading.Thread(target=_watch, args=(busy, limit, look), daemon=True).start()


def _watch(busy: Callable[[], bool], limit: float, look: float) -> None:
    still, used = 0.0, time.process_time()
    while still < limit:
        time.sleep(look)
        before, used = used, time.process_time()
        still = still + look if busy() and used - before < _LEAST * look else 0.0
    print(f"it stood still for {limit:g} seconds", file=sys.stderr, flush=True)
    os._exit(STUCK)


def _listen(heard: Callable[[str], None] | None, orphaned: Callable[[], None]) -> None:
    for line in sys.stdin:
        if heard is not None:
            heard(line)
    orphaned()


def _ask_for_signal(number: int) -> None:
    import ctypes

    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.Signals(number))
