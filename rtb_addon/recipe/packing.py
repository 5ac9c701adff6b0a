"""A recipe in one file, to be sent or kept: a zip of its folder with checksums."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import zipfile
from collections.abc import Iterator
from pathlib import Path

from ..archive_rules import wrongs
from ..errors import RecipeError
from ..files import replacing
from . import Recipe
from .locks import NAME as LOCK
from .named_files import NamedFiles
from .resources import GENERATED

CHECKSUMS = "SHA256SUMS"  # as sha256sum writes and checks it
# What renderings bring along, where they are asked for; native scenes are made anew from the recipe.
_RENDERED = ("renderings", "layers", "images", "log.jsonl")
_LEFT_OUT = {LOCK, CHECKSUMS, "log.jsonl", "__pycache__", *GENERATED}
_COMPRESSED = {".exr", ".png", ".jpg", ".jpeg", ".zip", ".zae", ".gz"}
_EPOCH = (1980, 1, 1, 0, 0, 0)  # the same files make the same archive, whenever that is


def pack_recipe(recipe: Recipe | Path | str, file: Path | str, *, renderings: bool = False) -> list[str]:
    """
    Write a recipe's folder into a zip and return a sentence for everything that is not in it.

    Everything that is the recipe's goes in, with all files that it names; what can be rendered again
    stays behind. The same recipe makes the same bytes.

    Parameters
    ----------
    file : the zip to write
    renderings : whether to take along radiance cubes, pictures and the log
    """
    recipe = recipe if isinstance(recipe, Recipe) else Recipe.load(recipe)
    named = NamedFiles(recipe)
    files, sentences = _files_of(recipe.folder, renderings)
    files |= {_name_of(path, recipe.folder): path for path in named.found.values()}
    target = Path(file).absolute()
    files = {name: path for name, path in sorted(files.items()) if path != target}
    with replacing(target) as temporary:
        _write(temporary, files, zipfile.ZIP_DEFLATED)
        if any(_wrongs(temporary)):  # so dull that it looks like a bomb
            _write(temporary, files, zipfile.ZIP_STORED)
        if (wrong := next(_wrongs(temporary), None)) is not None:
            raise RecipeError(f"it cannot be packed: {wrong}", recipe.folder)
    return [*sentences, *named.missing.values()]


def _files_of(folder: Path, renderings: bool) -> tuple[dict[str, Path], list[str]]:
    """Return the files to pack by their names in the archive, and sentences about what is none."""
    files, sentences = {}, []
    for path in _walked(folder, _LEFT_OUT - set(_RENDERED if renderings else ())):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and path.resolve().is_relative_to(folder.resolve()):
            files[name] = path
        else:
            sentences.append(f"{name} is no plain file of the folder and stays behind")
    return files, sentences


def _walked(folder: Path, left_out: set[str]) -> Iterator[Path]:
    """Yield the files below a folder, and links to folders, but nothing hidden."""
    for place, folders, files in os.walk(folder):
        here = Path(place)
        for name in sorted([*files, *folders]):
            hidden = name.startswith(".") or name.endswith("~") or (here == folder and name in left_out)
            if name in folders and (hidden or (here / name).is_symlink()):
                folders.remove(name)
            if not hidden and ((here / name).is_symlink() or name in files):
                yield here / name


def _name_of(path: Path, folder: Path) -> str:
    """Return a file's name in the archive; what the library served to a read-only folder is a resource."""
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else f"resources/{path.name}"


def _write(target: Path, files: dict[str, Path], method: int) -> None:
    with zipfile.ZipFile(target, "w") as archive:
        sums = [f"{_add(archive, name, path, method)}  {name}\n" for name, path in files.items()]
        archive.writestr(_member(CHECKSUMS, method), "".join(sums))


def _add(archive: zipfile.ZipFile, name: str, path: Path, method: int) -> str:
    """Add a file to an archive and return its digest."""
    method = zipfile.ZIP_STORED if path.suffix.lower() in _COMPRESSED else method
    with path.open("rb") as content, archive.open(_member(name, method), "w", force_zip64=True) as member:
        shutil.copyfileobj(content, member, 1 << 20)
        content.seek(0)
        return hashlib.file_digest(content, "sha256").hexdigest()


def _member(name: str, method: int) -> zipfile.ZipInfo:
    member = zipfile.ZipInfo(name, _EPOCH)
    member.compress_type, member.create_system = method, 3  # Unix, whatever this is
    member.external_attr = (stat.S_IFREG | 0o644) << 16
    return member


def _wrongs(file: Path) -> Iterator[str]:
    with zipfile.ZipFile(file) as archive:
        yield from wrongs(file.stat().st_size, archive.infolist())
