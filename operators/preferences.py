"""Edit > Preferences > Add-ons: what holds for all files of this user."""

from __future__ import annotations

import bpy

from ..rtb_addon.blender.properties import RENDERERS
from . import renderers_found, use_library_spectrum
from .test_renderers import RTB_OT_test_renderers

EXTENSION = (__package__ or "").rpartition(".")[0]  # the name under which Blender has enabled us


class RTB_AP_preferences(bpy.types.AddonPreferences):
    """What holds for all files of this user"""

    bl_idname = EXTENSION

    folder: bpy.props.StringProperty(
        name="Recipe Folder",
        description="Of new files; NAME stands for the recipe's name, // for the folder of the .blend",
        default="//rtb/NAME/",
        subtype="DIR_PATH",
    )
    renderer: bpy.props.EnumProperty(name="Renderer", description="Of new files", items=RENDERERS)
    spectra: bpy.props.StringProperty(
        name="Spectra",
        description="Folder of your own spectra, where imported ones go; empty: in Blender's user folder",
        subtype="DIR_PATH",
        update=lambda self, context: use_library_spectrum.forget(),
    )
    workers: bpy.props.IntProperty(
        name="Workers", description="Conditions rendered at once; 0: one for each core", min=0, soft_max=64
    )

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("folder", "renderer", "workers", "spectra"):
            layout.prop(self, name)
        header, body = layout.panel("RTB_renderers", default_closed=False)
        header.label(text="Renderers")
        if body is not None:
            draw_renderers(body)


def draw_renderers(layout) -> None:
    """Draw which renderers are here, in which version, and why one is not."""
    for name, found in renderers_found.found.items():
        row = layout.row()
        row.alert = found.version is None
        row.label(text=name.title(), icon="CHECKMARK" if found.version else "ERROR")
        row.label(text=found.version or found.reason)
    layout.operator(RTB_OT_test_renderers.bl_idname, icon="FILE_REFRESH")


def preferences() -> RTB_AP_preferences | None:
    """Return what the user prefers, None where the extension is not enabled as one."""
    addon = bpy.context.preferences.addons.get(EXTENSION)
    return None if addon is None else addon.preferences


def arguments() -> list[str]:
    """Return what the command line is told of them."""
    chosen = preferences()
    return ["--jobs", str(chosen.workers)] if chosen is not None and chosen.workers else []


def begin_file() -> None:
    """Give the scenes of a new file what the user prefers."""
    chosen = preferences()
    if chosen is None or bpy.data.filepath:
        return
    for scene in bpy.data.scenes:
        for name in ("folder", "renderer"):
            if not scene.rtb.is_property_set(name) and chosen.is_property_set(name):
                setattr(scene.rtb, name, getattr(chosen, name))
