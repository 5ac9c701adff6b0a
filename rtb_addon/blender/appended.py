"""
What comes from another .blend keeps naming its own files.

Blender itself makes the paths of images fit the file that they are appended to, but knows nothing of typed
spectra. What is linked stays as it is: its files are looked for beside its own .blend.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy

from .fields import fields_of, group_of

_APPENDED = ("MAKE_LOCAL", "COPY_LOCAL")
_THINGS = {"MATERIAL": "material", "LIGHT": "light", "WORLD": "world", "OBJECT": "object"}


@bpy.app.handlers.persistent
def _after_import(context) -> None:
    for item in context.import_items:
        if item.id is not None and item.append_action in _APPENDED and item.source_library is not None:
            home = Path(bpy.path.abspath(item.source_library.filepath)).parent
            for group, name in _paths_of(item.id, item.id_type):
                setattr(group, name, moved(getattr(group, name), home))


def moved(text: str, home: Path) -> str:
    """Return a path that is relative to a folder as it is said in the open file; other texts stay."""
    if not text.startswith("//"):
        return text
    whole = bpy.path.abspath(text, start=str(home))
    return bpy.path.relpath(whole) if bpy.data.filepath else whole


def _paths_of(thing, kind: str) -> Iterator[tuple]:
    """Yield the property groups of a thing and their properties that may name a file."""
    if kind in _THINGS:
        for field in fields_of(_THINGS[kind]):
            yield group_of(thing, field), field.name
    if kind == "MATERIAL":
        yield thing.rtb, "file"
    if kind == "SCENE":
        yield thing.rtb, "resources"
        for row in thing.rtb.conditions:
            for cell in row.cells:
                yield cell, "value"


def register() -> None:
    """Watch what is appended."""
    bpy.app.handlers.blend_import_post.append(_after_import)


def unregister() -> None:
    """Watch no more."""
    bpy.app.handlers.blend_import_post.remove(_after_import)
