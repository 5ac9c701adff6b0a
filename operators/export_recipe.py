"""Write the recipe of a scene to its folder."""

import bpy

from .reading import ReadingVerb


class RTB_OT_export_recipe(ReadingVerb, bpy.types.Operator):
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
