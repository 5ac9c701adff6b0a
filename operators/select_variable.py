"""Make a column of the table the active one, and offer what can be done with it."""

import bpy

MENU = "RTB_MT_variable"


class RTB_OT_select_variable(bpy.types.Operator):
    """Make this variable the active one; again: rename, move, duplicate or remove it"""

    bl_idname = "rtb.select_variable"
    bl_label = "Select Variable"
    bl_options = {"INTERNAL"}

    index: bpy.props.IntProperty(name="Index", min=0, options={"SKIP_SAVE"})

    def invoke(self, context, event):
        if self.index == context.scene.rtb.active_variable:
            return bpy.ops.wm.call_menu(name=MENU)
        return self.execute(context)

    def execute(self, context):
        if self.index >= len(context.scene.rtb.variables):
            return {"CANCELLED"}
        context.scene.rtb.active_variable = self.index
        return {"FINISHED"}
