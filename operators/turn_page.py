"""Other columns of a table that is wider than the sidebar."""

import bpy


class RTB_OT_turn_page(bpy.types.Operator):
    """Show the columns at the left or right of those that are shown"""

    bl_idname = "rtb.turn_page"
    bl_label = "Turn Page"
    bl_options = {"INTERNAL"}

    first: bpy.props.IntProperty(name="First Column", min=0, options={"SKIP_SAVE"})

    def execute(self, context):
        context.window_manager.rtb_first_variable = self.first
        return {"FINISHED"}
