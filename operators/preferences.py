"""Edit > Preferences > Add-ons: what holds for all files of this user."""

import bpy

from ..rtb_addon.blender import renderer_choices
from ..rtb_addon.blender.own_spectra import EXTENSION
from . import renderers_found, use_library_spectrum
from .preferred import preferences
from .spectra_folders import RTB_PG_spectra_folder, draw_folders
from .test_renderers import RTB_OT_test_renderers


class RTB_AP_preferences(bpy.types.AddonPreferences):
    """What holds for all files of this user"""

    bl_idname = EXTENSION

    folder: bpy.props.StringProperty(
        name="Recipe Folder",
        description="Of new files; NAME stands for the recipe's name, // for the folder of the .blend",
        default="//rtb/NAME/",
        subtype="DIR_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
    )
    renderer: bpy.props.EnumProperty(
        name="Renderer", description="Of new files", items=renderer_choices.choices, default=1
    )
    spectra: bpy.props.StringProperty(
        name="Spectra",
        description="Folder of your own spectra, where imported ones go; empty: in Blender's user folder",
        subtype="DIR_PATH",
        update=lambda self, context: use_library_spectrum.forget(),
    )
    spectra_folders: bpy.props.CollectionProperty(type=RTB_PG_spectra_folder)
    workers: bpy.props.IntProperty(
        name="Workers", description="Conditions rendered at once; 0: one for each core", min=0, soft_max=64
    )
    renderers: bpy.props.StringProperty(
        name="Further Renderers",
        description="Folder of packages that bring renderers of their own, as pip install --target fills one",
        subtype="DIR_PATH",
        update=lambda self, context: renderers_found.found.clear(),
    )
    # Names that a test has found there, for the next start.
    others: bpy.props.StringProperty(options={"HIDDEN"})

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "folder")
        layout.prop(self, "renderer")
        layout.prop(self, "workers", text="Workers" if self.workers else "Workers (0: Each Core)")
        layout.prop(self, "spectra", placeholder="In Blender's User Folder")
        layout.prop(self, "renderers", placeholder="None")
        draw_folders(layout.box(), self.spectra_folders)
        draw_renderers(layout.box())


def draw_renderers(layout) -> None:
    """Draw which renderers are here, in which version, and why one is not."""
    row = layout.row()
    row.label(text="Renderers")
    row.operator(RTB_OT_test_renderers.bl_idname, text="Test", icon="FILE_REFRESH")
    for name, found in renderers_found.found.items():
        row = layout.split(factor=0.3)
        row.alert = found.version is None
        row.label(text=name.title(), icon="CHECKMARK" if found.version else "ERROR")
        row.label(text=found.version or found.reason)


def offer_others() -> None:
    """Offer the renderers that a test has found in an earlier session."""
    if (chosen := preferences()) is not None and chosen.others:
        renderer_choices.learn(chosen.others.split())
