"""A recipe out of an archive, which somebody nobody knows may have made: all of it, or nothing."""

from __future__ import annotations

import hashlib
import io
import os
import shutil
import struct
import tempfile
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from zipfile import ZipFile, ZipInfo

from ..archive_rules import wrongs
from ..errors import RecipeError, at
from ..files import temporary_prefix, umask
from ..scene.document import Scene
from . import Recipe
from .locks import NAME as LOCK
from .packing import CHECKSUMS
from .words import RECIPE

_MOST_DIRECTORY = 16 << 20  # [bytes] of an archive's table of contents
_CHUNK = 1 << 20  # [bytes]
# Native scenes are made anew: a renderer would take a mesh that is there for the one it wants.
_LEFT_OUT = {LOCK, "scenes"}
_SCENES = {".dae", ".xml", ".zae"}


def unpack_recipe(file: Path | str, folder: Path | str) -> Recipe:
    """
    Make a recipe's folder of an archive and return the recipe; nothing in it is run.

    Raises
    ------
    RecipeError
        When the archive is damaged, holds what no recipe's archive should hold, or is no recipe's;
        then nothing was written.
    """
    file, folder = Path(file), Path(folder).absolute()
    if folder.is_symlink() or (folder.exists() and (not folder.is_dir() or any(folder.iterdir()))):
        raise RecipeError(f"{folder} is there already, name a new folder")
    with _opened(file) as archive, _new_folder(folder) as unfinished:
        _extract(archive, _wanted(file, archive), unfinished)
        with at(file):
            _compare(unfinished)
        _check(unfinished)
        folder.parent.mkdir(parents=True, exist_ok=True)
        if folder.is_dir():
            folder.rmdir()
        unfinished.rename(folder)
    return Recipe.load(folder)


class _Content(io.BufferedReader):
    """An archive's bytes, no more at once than its table of contents may have."""

    def read(self, size: int | None = -1, /) -> bytes:
        if size is None or size < 0:
            size = os.fstat(self.fileno()).st_size - self.tell()
        if size > _MOST_DIRECTORY:
            raise zipfile.BadZipFile("its table of contents is too long")
        return super().read(size)


@contextmanager
def _opened(file: Path) -> Iterator[ZipFile]:
    """Open an archive; whatever is wrong with its bytes becomes one sentence."""
    try:
        with _Content(io.FileIO(file)) as content, ZipFile(content) as archive:
            yield archive
    except (zipfile.BadZipFile, zlib.error, struct.error, EOFError, ValueError, NotImplementedError) as error:
        raise RecipeError(f"it is no zip, or it is damaged: {error}", file) from error
    except OSError as error:
        raise RecipeError(f"it cannot be unpacked: {error.strerror or error}", file) from error


def _wanted(file: Path, archive: ZipFile) -> dict[str, ZipInfo]:
    """Return the files to unpack by their names in the recipe's folder; raise what is wrong with any."""
    members = archive.infolist()
    if (wrong := next(wrongs(file.stat().st_size, members), None)) is not None:
        raise RecipeError(wrong, file)
    files = {member.filename: member for member in members if not member.is_dir()}
    roots = [name.removesuffix(RECIPE) for name in files if PurePosixPath(name).name == RECIPE]
    root = min(roots, key=len, default=None)
    if root is None or root.count("/") > 1:
        raise RecipeError(f"it is no recipe's archive: it holds no {RECIPE}", file)
    inside = {name.removeprefix(root): member for name, member in files.items() if name.startswith(root)}
    return {name: member for name, member in inside.items() if not _left_out(name)}


def _left_out(name: str) -> bool:
    parts = PurePosixPath(name).parts
    return parts[0] in _LEFT_OUT or any(part.startswith(".") for part in parts)


@contextmanager
def _new_folder(target: Path) -> Iterator[Path]:
    """Yield a new folder on the disk of a target; it is gone afterwards unless it was moved there."""
    place = next(folder for folder in target.parents if folder.is_dir())
    folder = Path(tempfile.mkdtemp(prefix=temporary_prefix(os.getpid()), dir=place))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _extract(archive: ZipFile, files: Mapping[str, ZipInfo], folder: Path) -> None:
    total, free = sum(member.file_size for member in files.values()), shutil.disk_usage(folder).free
    if total > free:
        raise OSError(f"it unpacks to {total} bytes, {folder.parent} has room for {free}")
    for name, member in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as content, (folder / name).open("xb") as target:
            shutil.copyfileobj(content, target, _CHUNK)
    folder.chmod(0o777 & ~umask())


def _compare(folder: Path) -> None:
    """Raise when files are not those that the archive's checksums name, where it has checksums."""
    if not (sums := folder / CHECKSUMS).is_file():
        return
    lines = sums.read_text(encoding="utf-8").splitlines()
    listed = {name: digest for digest, _, name in (line.partition("  ") for line in lines)}
    sums.unlink()
    there = {path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()}
    for name in sorted(name for name in listed.keys() ^ there.keys() if not _left_out(name)):
        raise RecipeError(f"{name!r} stands only in it or only in its {CHECKSUMS}, pack it again")
    for name, path in there.items():
        with path.open("rb") as content:
            if hashlib.file_digest(content, "sha256").hexdigest() != listed[name]:
                raise RecipeError(f"{name!r} is not what its checksum says, get the archive again")


def _check(folder: Path) -> None:
    """Raise when a recipe cannot be read, or when a scene in it may not be, as with entities."""
    Recipe.load(folder)
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() in _SCENES and path.is_file():
            Scene.read(path)
