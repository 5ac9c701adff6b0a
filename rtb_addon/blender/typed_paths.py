"""
Files that are typed as spectra are found again when things, or the whole .blend, come to another folder.

Blender itself makes the paths of images fit, but knows nothing of what is typed. What is linked stays as it
is: its files are looked for beside its own .blend.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import bpy

from .fields import fields_of, group_of

_APPENDED = ("MAKE_LOCAL", "COPY_LOCAL")
_THINGS = {"MATERIAL": "material", "LIGHT": "light", "WORLD": "world", "OBJECT": "object"}
_HOMES = {
    "MATERIAL": "materials",
    "LIGHT": "lights",
    "WORLD": "worlds",
    "OBJECT": "objects",
    "SCENE": "scenes",
}


@bpy.app.handlers.persistent
def _after_import(context) -> None:
    here = folder_of(bpy.data.filepath)
    for item in context.import_items:
        if item.id is not None and item.append_action in _APPENDED and item.source_library is not None:
            there = folder_of(bpy.path.abspath(item.source_library.filepath))
            _move(_paths_of(item.id, item.id_type), there, here)


@bpy.app.handlers.persistent
def _before_saving(file: str, *_) -> None:
    """Let what is saved in another folder name its files from there."""
    there, here = folder_of(bpy.data.filepath), folder_of(file)
    if there and here and there != here:
        _changed[:] = _move(_all_paths(), there, here)


@bpy.app.handlers.persistent
def _after_saving(file: str, *_) -> None:
    """Take that back where only a copy was saved, or nothing."""
    if folder_of(bpy.data.filepath) != folder_of(file):
        for group, name, before in _changed:
            setattr(group, name, before)
    _changed.clear()


# What a file that is being saved said before.
_changed: list[tuple] = []


def folder_of(file: str) -> Path | None:
    """Return the folder of a .blend; None of one that was never saved."""
    return Path(file).parent if file else None


def moved(text: str, there: Path | None, here: Path | None) -> str:
    """
    Return a path that is relative to one folder as it is said in another one, whole where that is none.

    Other texts stay, and paths of files that are not there, or that both folders have: somebody copied them.
    """
    if not text.startswith("//") or there is None or there == here:
        return text
    whole = bpy.path.abspath(text, start=str(there))
    if not Path(whole).exists() or (here and Path(bpy.path.abspath(text, start=str(here))).exists()):
        return text
    return bpy.path.relpath(whole, start=str(here)) if here else whole


def _move(paths: Iterator[tuple], there: Path | None, here: Path | None) -> list[tuple]:
    """Say paths anew, and return which have changed, with what they said."""
    said = [(group, name, getattr(group, name)) for group, name in paths]
    changed = [each for each in said if moved(each[2], there, here) != each[2]]
    for group, name, text in changed:
        setattr(group, name, moved(text, there, here))
    return changed


def _all_paths() -> Iterator[tuple]:
    for kind, home in _HOMES.items():
        for thing in getattr(bpy.data, home):
            if thing.library is None:
                yield from _paths_of(thing, kind)


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


_WATCHED = {
    "blend_import_post": _after_import,
    "save_pre": _before_saving,
    "save_post": _after_saving,
    "save_post_fail": _after_saving,
}


def register() -> None:
    """Watch what is appended and where files are saved."""
    for name, handler in _WATCHED.items():
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    """Watch no more."""
    for name, handler in _WATCHED.items():
        getattr(bpy.app.handlers, name).remove(handler)
