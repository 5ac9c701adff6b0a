"""One batch at a time in a folder."""

from __future__ import annotations

import json
import os
import socket
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from ..errors import RecipeError
from ..files import temporary_prefix
from ..processes import born, runs

NAME = "batch.lock"


class Holder(NamedTuple):
    """
    Who holds a lock.

    Parameters
    ----------
    pid, host : the process and its computer
    born : when that process started, as its system counts; tells it from a later one of the same pid
    since : when it took the lock, for people
    """

    pid: int
    host: str
    born: str
    since: str

    @property
    def alive(self) -> bool:
        """Whether it may still be at work; of another computer nothing is known, so it may."""
        return self.host != socket.gethostname() or (runs(self.pid) and born(self.pid) == self.born)

    @classmethod
    def here(cls) -> Holder:
        """Return this process."""
        now = time.strftime("%Y-%m-%d %H:%M:%S")
        return cls(os.getpid(), socket.gethostname(), born(os.getpid()), now)


def holder(folder: Path) -> Holder | None:
    """Return who renders in a folder now, if anybody does."""
    found = _read(folder / NAME)
    return found if found is not None and found.alive else None


def refuse_if_locked(folder: Path) -> None:
    """Raise one sentence that names who renders in a folder, if anybody does."""
    if (other := holder(folder)) is not None:
        raise RecipeError(
            f"process {other.pid} on {other.host} has been rendering {folder} since {other.since}; "
            f"wait or stop it (if it no longer runs, delete {NAME})"
        )


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold a folder's lock; raise one sentence when somebody else does, take over a dead one's."""
    path = folder / NAME
    mine = json.dumps(Holder.here()._asdict()).encode()
    while not _create(path, mine):
        refuse_if_locked(folder)
        _clear_away(path)
    try:
        yield
    finally:
        with suppress(OSError):
            if path.read_bytes() == mine:
                path.unlink()


def _create(path: Path, content: bytes) -> bool:
    """Create a lock that holds all its content from its first moment; return whether nobody was quicker."""
    try:
        handle, name = tempfile.mkstemp(prefix=temporary_prefix(os.getpid()), dir=path.parent)
    except OSError as error:
        raise RecipeError(
            f"cannot write into {path.parent} ({error.strerror}); make it writable, or render a copy of it"
        ) from error
    try:
        with os.fdopen(handle, "wb") as temporary:
            temporary.write(content)
        return _link(Path(name), path)
    finally:
        Path(name).unlink(missing_ok=True)


def _link(whole: Path, path: Path) -> bool:
    try:
        path.hardlink_to(whole)
    except FileExistsError:
        return False
    except OSError:  # a file system without links: a moment of emptiness must do
        return _write_anew(path, whole.read_bytes())
    return True


def _write_anew(path: Path, content: bytes) -> bool:
    try:
        with path.open("xb") as file:
            file.write(content)
    except FileExistsError:
        return False
    return True


def _clear_away(path: Path) -> None:
    """Remove a dead process's lock, unless somebody took it over in this very moment."""
    aside = path.with_name(f"{temporary_prefix(os.getpid())}{time.monotonic_ns()}-{NAME}")
    try:
        path.rename(aside)
    except FileNotFoundError:
        return
    if (found := _read(aside)) is not None and found.alive:
        _link(aside, path)
    aside.unlink()


def _read(path: Path) -> Holder | None:
    try:
        words = json.loads(path.read_bytes())
        return Holder(int(words["pid"]), str(words["host"]), str(words["born"]), str(words["since"]))
    except (OSError, ValueError, KeyError, TypeError):
        return None
