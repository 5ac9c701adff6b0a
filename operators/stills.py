"""Where the cubes are that Render Image has rendered: recipes of one condition, below the scene's own."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..rtb_addon.blender.folders import is_unsaved, recipe_folder
from ..rtb_addon.errors import RecipeError

STILL = "still"  # the folder, below the recipe's


def still_home(scene) -> Path:
    """Return the folder of a scene's stills; while its recipe has no folder one that passes with Blender."""
    home = Path(bpy.app.tempdir) if is_unsaved(scene) else recipe_folder(scene)
    return home / STILL


def newest_still(scene) -> Path:
    """Return the folder of what Render Image has rendered last."""
    home = still_home(scene)
    cubes = [*home.glob("renderings/*/*.exr"), *home.glob("**/renderings/*/*.exr")]
    if not cubes:
        raise RecipeError("nothing was rendered with RenderToolbox as the render engine yet, press F12")
    return max(cubes, key=lambda cube: cube.stat().st_mtime_ns).parents[2]
