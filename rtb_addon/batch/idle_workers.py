"""
Workers that have nothing to do, kept warm by a process that does errands for a batch elsewhere.

A worker waits only while its batch does: once that is gone, or has asked for nothing for a minute, it stops.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from ..background import EventStream, stop_all

GRACE = 0.4  # [s] that workers have to stop
PATIENCE = 60.0  # [s] without an errand after which a worker stops, though its batch may be alive
INTERVAL = 0.3  # [s] between two looks at whether the batch is


@dataclass
class _Bench:
    """A batch's idle workers in this process."""

    workers: list[EventStream] = field(default_factory=list)
    used: float = field(default_factory=time.monotonic)
    watched: bool = False


_benches: dict[str, _Bench] = {}
_lock = threading.Lock()


def take(batch: str) -> EventStream | None:
    """Return a worker that waits for errands of a batch, if there is one alive."""
    with _lock:
        bench = _benches.get(batch)
        while bench and bench.workers:
            bench.used = time.monotonic()
            if (worker := bench.workers.pop()).process.poll() is None:
                return worker
            stop_all([worker.process], 0)
    return None


def keep(batch: str, worker: EventStream, gone: Callable[[], bool]) -> None:
    """Let a worker wait for the next errand of a batch, until gone() says that there will be none."""
    with _lock:
        bench = _benches.setdefault(batch, _Bench())
        bench.workers.append(worker)
        bench.used = time.monotonic()
        start, bench.watched = not bench.watched, True
    if start:
        threading.Thread(target=_watch, args=(batch, bench, gone), daemon=True).start()


def dismiss(batch: str) -> None:
    """Stop the idle workers of a batch in this process."""
    with _lock:
        bench = _benches.pop(batch, None)
    if bench is not None:
        stop_all([worker.process for worker in bench.workers], GRACE)


def _watch(batch: str, bench: _Bench, gone: Callable[[], bool]) -> None:
    while _benches.get(batch) is bench and not gone() and time.monotonic() - bench.used < PATIENCE:
        time.sleep(INTERVAL)
    if _benches.get(batch) is bench:
        dismiss(batch)


# A process that was forked from this one has no children of its own yet.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_benches.clear)
