"""What the user prefers, for all files; nothing where the extension is not enabled as one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..rtb_addon.blender.own_spectra import EXTENSION

if TYPE_CHECKING:
    from .preferences import RTB_AP_preferences


def preferences() -> RTB_AP_preferences | None:
    """Return what the user prefers, None where the extension is not enabled as one."""
    addon = bpy.context.preferences.addons.get(EXTENSION)
    return None if addon is None else addon.preferences


def arguments() -> list[str]:
    """Return what the command line is told of them."""
    chosen = preferences()
    return ["--jobs", str(chosen.workers)] if chosen is not None and chosen.workers else []


def renderer_folders() -> list[str]:
    """Return the folders that children import further renderers from."""
    chosen = preferences()
    return [bpy.path.abspath(chosen.renderers)] if chosen is not None and chosen.renderers else []


def begin_file() -> None:
    """Give the scenes of a new file what the user prefers."""
    chosen = preferences()
    if chosen is None or bpy.data.filepath:
        return
    for scene in bpy.data.scenes:
        for name in ("folder", "renderer"):
            if not scene.rtb.is_property_set(name) and chosen.is_property_set(name):
                setattr(scene.rtb, name, getattr(chosen, name))
