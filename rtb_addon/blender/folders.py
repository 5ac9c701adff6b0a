"""Where a scene's recipe goes, and where the files lie that it names."""

from __future__ import annotations

import re
from pathlib import Path

import bpy

from ..errors import RecipeError

# The word NAME where it is a whole folder.
_NAME = re.compile(r"(?<![^/\\])NAME(?![^/\\])")
_UNSAFE = re.compile(r'[\x00-\x1f<>:"/\\|?*]')


def recipe_name(scene) -> str:
    """Return the name of a scene's recipe: what it says, else that of the .blend, else the scene's."""
    return safe_name(scene.rtb.name.strip() or Path(bpy.data.filepath).stem or scene.name)


def safe_name(text: str) -> str:
    """Return a text as the name of a folder that any system can have."""
    return _UNSAFE.sub("_", text).strip(" .") or "recipe"


def recipe_folder(scene) -> Path:
    """Return the folder that a scene's recipe is written to."""
    name = recipe_name(scene)
    said = _NAME.sub(lambda _: name, _said(scene))
    if is_unsaved(scene):
        raise RecipeError(f"the recipe's folder {said} is relative to the .blend file: save that first")
    return Path(bpy.path.abspath(said))


def _said(scene) -> str:
    return scene.rtb.folder.strip() or "//rtb/NAME/"


def is_unsaved(scene) -> bool:
    """Return whether the .blend file must be saved before it is known where a scene's recipe goes."""
    return _said(scene).startswith("//") and not bpy.data.filepath


def own_folder(scene) -> Path:
    """Return the folder that a scene's recipe may be written to, where no other one of this file goes."""
    folder = recipe_folder(scene)
    for other in bpy.data.scenes:
        if other == scene or other.library is not None or not len(other.rtb.conditions):
            continue
        if recipe_folder(other) == folder:
            raise RecipeError(
                f"the recipes of the scenes {scene.name} and {other.name} both go to {folder}, "
                "give one of them another name"
            )
    return folder


def written_folder(scene) -> Path:
    """Return the folder of a scene's recipe once it was written."""
    folder = recipe_folder(scene)
    if not (folder / "recipe.json").is_file():
        raise RecipeError(f"there is no recipe in {folder} yet, press Render Recipe")
    return folder


def typed(text: str, owner) -> str:
    """Return a spectrum as typed into a property of a datablock, a ``//`` file with its whole path."""
    text = text.strip()
    return bpy.path.abspath(text, library=owner.library) if text.startswith("//") else text


def blend_folder() -> Path | None:
    """Return the folder of the .blend file, where relative files are looked for; None when unsaved."""
    return Path(bpy.data.filepath).parent if bpy.data.filepath else None
