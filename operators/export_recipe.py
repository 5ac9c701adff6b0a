"""Write the recipe of a scene to its folder."""

import bpy

from ..rtb_addon.blender import read_recipe
from ..rtb_addon.errors import RecipeError
from . import findings


class RTB_OT_export_recipe(bpy.types.Operator):
    """Write the recipe to its folder, ready to render anywhere"""

    bl_idname = "rtb.export_recipe"
    bl_label = "Export Recipe"
    bl_options = {"REGISTER"}

    folder: bpy.props.StringProperty(
        name="Folder",
        description="Where the recipe is written; empty for the scene's own folder",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
    )

    def execute(self, context):
        try:
            folder = findings.exported(read_recipe(context.scene), self.folder)
        except RecipeError as error:
            return findings.refuse(self, error)
        self.report({"INFO"}, f"Recipe written to {folder}")
        return {"FINISHED"}
