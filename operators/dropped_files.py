"""Files that are dropped on Blender's window."""

import bpy

from .import_recipe import ENDINGS, RTB_OT_import_recipe


class RTB_FH_recipe(bpy.types.FileHandler):
    """A recipe that is dropped on a 3D Viewport or an Outliner is opened"""

    bl_idname = "RTB_FH_recipe"
    bl_label = "RenderToolbox Recipe"
    bl_import_operator = RTB_OT_import_recipe.bl_idname
    bl_file_extensions = ENDINGS

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type in ("VIEW_3D", "OUTLINER")
