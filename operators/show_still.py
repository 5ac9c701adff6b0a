"""Show what Render Image has rendered, with its spectra."""

import bpy

from ..rtb_addon.errors import RecipeError
from . import findings, stills, viewing


class RTB_OT_show_still(bpy.types.Operator):
    """Show what Render Image has rendered last in this panel's views, where the probe reads its spectra"""

    bl_idname = "rtb.show_still"
    bl_label = "Show Render Spectra"
    bl_options = {"REGISTER"}

    def execute(self, context):
        try:
            folder = stills.newest_still(context.scene)
        except RecipeError as error:
            return findings.refuse(self, error)
        context.window_manager.rtb_view.condition = ""
        viewing.show(folder, open_editor=True)
        return {"FINISHED"}
