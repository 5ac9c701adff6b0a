"""A parent scene in a zip: Collada's .zae, without surprises."""

from __future__ import annotations

import stat
import zipfile
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import NamedTuple
from urllib.parse import unquote

from ..errors import RecipeError

_MANIFEST = "manifest.xml"
# What an archive may hold at most: files, and bytes of all of them [B].
_FILES, _BYTES = 10_000, 2**31
_CHUNK = 2**20


class Archive(NamedTuple):
    """
    What a .zae holds.

    Parameters
    ----------
    name : of the scene's file in it
    scene : its bytes
    others : the other files, by their names
    """

    name: str
    scene: bytes
    others: Mapping[str, bytes]

    def beside_the_scene(self) -> dict[str, bytes]:
        """Return the files that the scene may name, by their names seen from where it is."""
        folder = PurePosixPath(self.name).parent
        names = {name: PurePosixPath(name) for name in self.others if name != _MANIFEST}
        return {
            str(path.relative_to(folder) if path.is_relative_to(folder) else path): self.others[name]
            for name, path in names.items()
        }


def is_archive(data: bytes) -> bool:
    """Return whether some bytes are a zip."""
    return data.startswith(b"PK\x03\x04")


def read_archive(data: bytes, file: str | Path) -> Archive:
    """Return what an archive holds; one sentence for links, ways out of it, and more than it admits."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            files = _files(archive, file)
    except (zipfile.BadZipFile, NotImplementedError, EOFError, OSError) as error:
        raise RecipeError(f"this is no readable zip: {error}", file) from error
    name = _main_scene(files, file)
    return Archive(name, files.pop(name), files)


def _files(archive: zipfile.ZipFile, file: str | Path) -> dict[str, bytes]:
    entries = [each for each in archive.infolist() if not each.is_dir()]
    if len(entries) > _FILES or sum(each.file_size for each in entries) > _BYTES:
        raise RecipeError(
            f"it holds more than {_FILES} files or {_BYTES >> 20} MiB, unpack it yourself", file
        )
    found: dict[str, bytes] = {}
    left = _BYTES
    for each in entries:
        name = _safe_name(each, file)
        if name in found:
            raise RecipeError(f"it holds two files called {name}", file)
        found[name] = _content(archive, each, left, file)
        left -= len(found[name])
    return found


def _safe_name(entry: zipfile.ZipInfo, file: str | Path) -> str:
    name = entry.filename
    outside = PurePosixPath(name).is_absolute() or PureWindowsPath(name).drive or "\\" in name
    if outside or ".." in PurePosixPath(name).parts:
        raise RecipeError(f"'{name}' in it leads outside, pack it anew", file)
    if stat.S_ISLNK(entry.external_attr >> 16):
        raise RecipeError(f"'{name}' in it is a link, pack the file itself", file)
    if entry.flag_bits & 1:
        raise RecipeError(f"'{name}' in it is encrypted, pack it without a password", file)
    return str(PurePosixPath(name))


def _content(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, most: int, file: str | Path) -> bytes:
    """Return an entry's bytes, which may be more than it says itself."""
    chunks: list[bytes] = []
    with archive.open(entry) as opened:
        while chunk := opened.read(_CHUNK):
            chunks.append(chunk)
            most -= len(chunk)
            if most < 0:
                raise RecipeError(f"it unpacks to more than {_BYTES >> 20} MiB, unpack it yourself", file)
    return b"".join(chunks)


def _main_scene(files: Mapping[str, bytes], file: str | Path) -> str:
    """Return the scene that the manifest names, or the only one there is."""
    if (manifest := files.get(_MANIFEST)) is not None:
        named = _rooted(manifest, file)
        for name in (named, unquote(named)):
            plain = str(PurePosixPath(name.partition("#")[0]))
            if plain in files:
                return plain
        raise RecipeError(f"its {_MANIFEST} names the scene '{named}', which it does not hold", file)
    scenes = [name for name in files if name.lower().endswith(".dae")]
    if len(scenes) != 1:
        raise RecipeError(f"it holds {len(scenes)} scenes and no {_MANIFEST} that names one", file)
    return scenes[0]


def _rooted(manifest: bytes, file: str | Path) -> str:
    from lxml import etree

    if b"<!" in manifest.replace(b"<!--", b""):
        raise RecipeError(f"its {_MANIFEST} may declare no document type and no entities", file)
    try:
        root = etree.fromstring(manifest, etree.XMLParser(resolve_entities=False, no_network=True))
    except etree.XMLSyntaxError as error:
        raise RecipeError(f"its {_MANIFEST} is no XML: {error.msg}", file) from error
    found = next((each for each in root.iter("{*}*") if each.tag.rpartition("}")[2] == "dae_root"), None)
    return "" if found is None else (found.text or "").strip()
