"""The shipped materials among the user's asset libraries, as long as the extension is enabled."""

from __future__ import annotations

from pathlib import Path

import bpy

NAME = "RenderToolbox"
FOLDER = Path(__file__).resolve().parents[2] / "assets"  # made by packaging/make_assets.py, in the zip only


def register(folder: Path = FOLDER) -> None:
    """Let the Asset Browser show the materials, where they are."""
    if folder.is_dir() and _found(folder) is None:
        library = _libraries().new(name=NAME, directory=str(folder))
        try:
            library.import_method = "APPEND_REUSE"
        except TypeError:  # Blender 5 has no word for taking the same one twice; linked ones cannot be edited
            library.import_method = "APPEND"


def unregister(folder: Path = FOLDER) -> None:
    """Take them out again; what has been appended to files stays there."""
    if (library := _found(folder)) is not None:
        _libraries().remove(library)


def _found(folder: Path):
    """Return the library that shows a folder, also one that preferences have kept."""
    same = (each for each in _libraries() if Path(each.path) == folder)
    return next(same, None)


def _libraries():
    return bpy.context.preferences.filepaths.asset_libraries
