"""Child processes that do the slow work, and the events they tell."""

from __future__ import annotations

import dataclasses
import json
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Literal

from .child_environment import child_environment

Kind = Literal["started", "progress", "done", "cached", "failed", "cancelled", "finished"]

# Children that were started before somebody asked for them, by what start_child will be told.
_early: dict[tuple, subprocess.Popen] = {}


@dataclass(frozen=True)
class Event:
    """
    Something that happened to a condition, or to the whole batch where no condition is named.

    Parameters
    ----------
    kind : finished is the last event of a batch that was not cancelled
    condition, renderer : whose rendering it is
    fraction : how much of this rendering is done, 0 to 1
    finished, total : conditions of the batch that need no more work, and all of them
    remaining : expected time until the batch ends [s], None while nobody can know
    message : one sentence, for failed
    details : more for whoever looks for the cause, in the log only
    fault : for failed, whether the recipe is wrong or only this rendering failed
    file : the radiance cube, for done and cached; the montage, for finished
    seconds : what the rendering took [s]
    warnings : one sentence each
    """

    kind: Kind
    condition: str = ""
    renderer: str = ""
    fraction: float = 0.0
    finished: int = 0
    total: int = 0
    remaining: float | None = None
    message: str = ""
    details: str = ""
    fault: Literal["", "recipe", "rendering"] = ""
    file: str = ""
    seconds: float = 0.0
    warnings: tuple[str, ...] = ()

    def to_json(self) -> str:
        """Return the event as one line, without what is unsaid."""
        said = {
            item.name: value
            for item in dataclasses.fields(self)
            if (value := getattr(self, item.name)) != item.default
        }
        return json.dumps(said)

    @classmethod
    def from_json(cls, line: str) -> Event:
        """Return the event of a line; a later version's additions are left out."""
        words = json.loads(line)
        known = {item.name for item in dataclasses.fields(cls)}
        words["warnings"] = tuple(words.get("warnings", ()))
        return cls(**{name: value for name, value in words.items() if name in known})


def start_child(
    arguments: list[str],
    module: str = "rtb_addon",
    threads: int | None = None,
    heard: bool = True,
    folders: Sequence[str] = (),
) -> subprocess.Popen:
    """
    Start ``python -m rtb_addon ARGUMENTS`` with the Python that runs here.

    Its standard streams are pipes of text: read them with an EventStream. It stops by itself when
    its standard input closes or its parent dies. The folder it is started in is no place to import
    from, since that may be a stranger's recipe.

    Notes
    -----
    The child inherits the environment. That is right for variables of a launcher too, such as
    DRJIT_LIBLLVM_PATH of a Blender in a folder of its own: the child is the same Python with the
    same system libraries. Nothing here starts another Python.

    Parameters
    ----------
    threads : what numerical libraries may use; None leaves it to them
    heard : whether we read what it says; else that goes where what we say goes
    folders : further ones that it imports from
    """
    output = subprocess.PIPE if heard else None
    early = _early.pop((module, *arguments, threads), None)
    if early is not None and early.poll() is None:
        return early
    return subprocess.Popen(
        [sys.executable, "-P", "-m", module, *arguments],
        stdin=subprocess.PIPE,
        stdout=output,
        stderr=output,
        encoding="utf-8",
        errors="replace",
        env=child_environment(threads, folders),
        # A group of its own: a Ctrl-C is the parent's to handle, and one kill takes its children too.
        start_new_session=True,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    )


def run_child(arguments: list[str], module: str = "rtb_addon") -> int:
    """Run ``python -m rtb_addon ARGUMENTS`` to its end in our place, and return its exit status."""
    with start_child(arguments, module, heard=False) as child:
        while True:
            try:
                status = child.wait()
                return status if status >= 0 else 128 - status  # a signal, as shells say it
            except KeyboardInterrupt:  # ours alone, for it is in a group of its own
                _interrupt(child)


def start_early(arguments: list[str], module: str, threads: int | None = None) -> None:
    """Start a child that start_child will soon be asked for in the same words; that one then returns it."""
    with suppress(OSError):  # for whoever asks for it
        _early[module, *arguments, threads] = start_child(arguments, module, threads)


def stop_early() -> None:
    """Stop the children that nobody has asked for."""
    while _early:
        with _early.popitem()[1] as process:  # whose pipes nobody reads
            stop(process, 0)


class EventStream:
    """
    Reads what a child says in threads, so that nobody waits for it.

    Parameters
    ----------
    process : from start_child
    inbox : where (stream, event) goes, with None for the end; its own unless several streams share one
    parse : makes an event of a line
    """

    def __init__(
        self,
        process: subprocess.Popen,
        inbox: queue.SimpleQueue | None = None,
        parse: Callable[[str], Any] = Event.from_json,
    ) -> None:
        self.process = process
        self.inbox = inbox or queue.SimpleQueue()
        self.ended = False
        self._parse = parse
        self._words: deque[str] = deque(maxlen=20)
        self._threads = [
            threading.Thread(target=read, daemon=True) for read in (self._read_events, self._read_words)
        ]
        for thread in self._threads:
            thread.start()

    def ready(self) -> list[Any]:
        """Return the events that came since the last call; sets ``ended`` after the last one."""
        events = []
        with suppress(queue.Empty):
            while not self.ended:
                _, event = self.inbox.get_nowait()
                self.ended = event is None
                events += [event] if event else []
        return events

    def last_words(self) -> str:
        """Return the last lines that an ended child wrote to its standard error."""
        self._threads[1].join(timeout=1.0)
        return "\n".join(self._words)

    def _read_events(self) -> None:
        assert self.process.stdout is not None
        with self.process.stdout as lines:
            for line in lines:
                with suppress(ValueError, TypeError, AttributeError):  # not every line need be ours
                    self.inbox.put((self, self._parse(line)))
        self.inbox.put((self, None))

    def _read_words(self) -> None:
        assert self.process.stderr is not None
        with self.process.stderr as lines:
            self._words.extend(line.rstrip() for line in lines if line.strip())


def send(process: subprocess.Popen, line: str) -> bool:
    """Write a line to a child; return whether it still listens."""
    assert process.stdin is not None
    try:
        process.stdin.write(line + "\n")
        process.stdin.flush()
    except (OSError, ValueError):
        return False
    return True


def stop(process: subprocess.Popen, grace: float = 1.0) -> None:
    """Ask a child to stop by closing its input; kill it with its own children after a grace time [s]."""
    stop_all([process], grace)


def stop_all(processes: list[subprocess.Popen], grace: float) -> None:
    """Stop several children, which share one grace time [s]."""
    for process in processes:
        close_input(process)
    end = time.monotonic() + grace
    for process in processes:
        try:
            process.wait(max(0.0, end - time.monotonic()))
        except subprocess.TimeoutExpired:
            _kill(process)
            process.wait()


def close_input(process: subprocess.Popen) -> None:
    """Let a child know that nothing more will come."""
    assert process.stdin is not None
    with suppress(OSError):
        process.stdin.close()


def _interrupt(process: subprocess.Popen) -> None:
    """Let a child stop as by Ctrl-C; where there is no way to say that, by closing its input."""
    if os.name == "posix":
        process.send_signal(signal.SIGINT)
    else:
        stop(process)


def _kill(process: subprocess.Popen) -> None:
    with suppress(OSError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
