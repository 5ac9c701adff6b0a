"""The folder of a scene's recipe in the system's file browser."""

import bpy

from ..rtb_addon.blender.folders import written_folder
from ..rtb_addon.errors import RecipeError
from . import findings


class RTB_OT_open_folder(bpy.types.Operator):
    """Show the recipe's folder in the file browser of the system"""

    bl_idname = "rtb.open_folder"
    bl_label = "Open Folder"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            folder = written_folder(context.scene)
        except RecipeError as error:
            return findings.refuse(self, error)
        return bpy.ops.wm.path_open(filepath=str(folder))
