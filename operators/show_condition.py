"""One condition's rendering in the Image Editor, from the icon of its row, which also says how the row is."""

import bpy

from ..rtb_addon.blender.folders import recipe_folder
from ..rtb_addon.errors import RecipeError
from . import findings, row_states, viewing

# How a row is, as its icon's tooltip says it.
SENTENCES = {
    "": "Not rendered yet",
    "running": "Being rendered",
    "done": "Rendered as it is now, click to show it in the Image Editor",
    "unchecked": "Rendered, the scene has been edited since: Check finds out whether that matters",
    "changed": "The row or the options have been changed since it was rendered",
    "failed": "Failed",
}


class RTB_OT_show_condition(bpy.types.Operator):
    """Show one condition's rendering in the Image Editor"""

    bl_idname = "rtb.show_condition"
    bl_label = "Show Condition"
    bl_options = {"REGISTER", "INTERNAL"}

    condition: bpy.props.StringProperty(name="Condition", description="Its name", options={"SKIP_SAVE"})

    @classmethod
    def does(cls, context, properties) -> str:
        """Return the tooltip's first sentence: how the row is."""
        sentence = SENTENCES[row_states.state_of(context.scene, properties.condition)]
        why = row_states.reason(context.scene, properties.condition)
        return f"{sentence}: {why}" if why else sentence

    def execute(self, context):
        if why := row_states.reason(context.scene, self.condition):
            return findings.refuse(self, RecipeError(f"{self.condition}: {why}"))
        try:
            folder = recipe_folder(context.scene)
        except RecipeError as error:
            return findings.refuse(self, error)
        context.window_manager.rtb_view.condition = self.condition
        viewing.show(folder, open_editor=True)
        return {"FINISHED"}
