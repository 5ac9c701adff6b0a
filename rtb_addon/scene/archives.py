"""A parent scene in a zip: Collada's .zae, without surprises."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path, PurePosixPath
from typing import NamedTuple
from urllib.parse import unquote

from ..archive_rules import wrongs
from ..errors import RecipeError

MOST_BYTES = 2 << 30  # that a scene and its pictures may take in memory
_MANIFEST = "manifest.xml"


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


def taken_out(data: bytes, file: str | Path) -> tuple[bytes, dict[str, bytes]]:
    """Return a parent scene and the files that came with it in an archive; none where it is no archive."""
    if not is_archive(data):
        return data, {}
    archive = read_archive(data, file)
    return archive.scene, archive.beside_the_scene()


def files_beside(scene: Path) -> dict[str, bytes]:
    """Return the files that a parent scene's archive holds for it; none where it is no archive."""
    with scene.open("rb") as content:
        if not is_archive(start := content.read(4)):
            return {}
        return read_archive(start + content.read(), scene).beside_the_scene()


def read_archive(data: bytes, file: str | Path) -> Archive:
    """Return what an archive holds; one sentence for links, ways out of it, and more than it admits."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            files = _files(archive, len(data), file)
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, EOFError, OSError) as error:
        raise RecipeError(f"this is no readable zip: {error}", file) from error
    name = _main_scene(files, file)
    return Archive(name, files.pop(name), files)


def _files(archive: zipfile.ZipFile, size: int, file: str | Path) -> dict[str, bytes]:
    members = archive.infolist()
    if (wrong := next(wrongs(size, members, MOST_BYTES), None)) is not None:
        raise RecipeError(wrong, file)
    return {str(PurePosixPath(each.filename)): archive.read(each) for each in members if not each.is_dir()}


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
