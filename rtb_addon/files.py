"""Files that are there whole or not at all."""

from __future__ import annotations

import glob
import os
import socket
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from .errors import RecipeError
from .processes import runs


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """
    Yield a temporary file beside a path, of the same suffix, that takes its place when all went well.

    A crash leaves the old file or the new one, never half of one.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(
            suffix=path.suffix, prefix=temporary_prefix(os.getpid()), dir=path.parent
        )
    except OSError as error:
        raise RecipeError(f"cannot write {path.name} into {path.parent}: {error.strerror}") from error
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~umask())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes) -> bool:
    """Write a file unless it already holds just this; return whether it was written."""
    if path.is_file() and path.stat().st_size == len(content) and path.read_bytes() == content:
        return False
    with replacing(path) as temporary:
        temporary.write_bytes(content)
    return True


def write_text(path: Path, content: str) -> bool:
    """Write a UTF-8 file with Unix line ends unless it already holds just this."""
    return write_bytes(path, content.encode())


def sweep(folder: Path) -> None:
    """Remove the temporary files that killed processes of this computer left below a folder."""
    mine = temporary_prefix(0).removesuffix("0-")
    for file in folder.rglob(f"{glob.escape(mine)}*"):
        pid = file.name.removeprefix(mine).partition("-")[0]
        if pid.isdigit() and not runs(int(pid)):
            with suppress(OSError):
                file.unlink()


def temporary_prefix(pid: int) -> str:
    """Return how the temporary files of a process of this computer begin."""
    return f".writing-{socket.gethostname()}-{pid}-"


def umask() -> int:
    """Return which permissions this process gives nobody."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
