"""
Files that are dropped on Blender's window: spectra go into the library, recipes are opened.

Blender asks handlers by a file's ending, so folders never come here; zips it takes for extensions itself.
"""

import bpy

from . import import_recipe, import_spectra

# Editors where what is dropped means something else to Blender.
ELSEWHERE = ("TEXT_EDITOR", "FILE_BROWSER", "NODE_EDITOR", "SEQUENCE_EDITOR", "CLIP_EDITOR", "CONSOLE")


class DroppedFiles:
    """What both kinds have in common: they are taken nearly everywhere."""

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type not in ELSEWHERE


class RTB_FH_recipe(DroppedFiles, bpy.types.FileHandler):
    """A recipe that is dropped on the window is opened: its recipe.json, or the files of an old one"""

    bl_idname = "RTB_FH_recipe"
    bl_label = "RenderToolbox Recipe"
    bl_import_operator = import_recipe.RTB_OT_import_recipe.bl_idname
    bl_file_extensions = import_recipe.ENDINGS.replace(".zip;", "")


class RTB_FH_spectra(DroppedFiles, bpy.types.FileHandler):
    """Spectra that are dropped on the window go into the library"""

    bl_idname = "RTB_FH_spectra"
    bl_label = "Spectra for the Library"
    bl_import_operator = import_spectra.RTB_OT_import_spectra.bl_idname
    bl_file_extensions = import_spectra.ENDINGS
