"""Show the montage of a scene's recipe in an Image Editor."""

import bpy

from ..rtb_addon.blender.folders import recipe_folder, recipe_name
from ..rtb_addon.errors import RecipeError
from . import findings, montages, viewing


class RTB_OT_show_montage(bpy.types.Operator):
    """Show all renderings as one picture, in an Image Editor beside the viewport if none is open"""

    bl_idname = "rtb.show_montage"
    bl_label = "Show Montage"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            if bpy.app.background:
                montages.load(montage_file(context.scene), recipe_name(context.scene))
            else:
                context.window_manager.rtb_view.condition = ""
                viewing.show(recipe_folder(context.scene), open_editor=True)
        except RecipeError as error:
            return findings.refuse(self, error)
        return {"FINISHED"}


def montage_file(scene):
    """Return the picture that the last batch of a scene's recipe left."""
    from ..rtb_addon.recipe import Recipe  # brings much that enabling the extension need not wait for

    folder = recipe_folder(scene)
    file = Recipe(folder, recipe_name(scene)).montage_file(scene.rtb.renderer)
    if not file.is_file():
        raise RecipeError(f"there is no montage in {folder} yet, press Render Recipe")
    return file
