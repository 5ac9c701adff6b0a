"""The active condition in the viewport."""

import bpy

from ..rtb_addon.blender import preview


class RTB_OT_preview_condition(bpy.types.Operator):
    """Show the active condition in the viewport, or no longer; the file stays as it is"""

    bl_idname = "rtb.preview_condition"
    bl_label = "Preview Condition"
    bl_options = {"REGISTER"}

    show: bpy.props.BoolProperty(name="Show", default=True, options={"SKIP_SAVE"})

    def execute(self, context):
        if self.show and not len(context.scene.rtb.conditions):
            self.report({"ERROR"}, "There is no condition to preview: add one")
            return {"CANCELLED"}
        context.window_manager.rtb_preview = self.show
        if self.show and (problems := preview.problems()):
            self.report({"WARNING"}, problems[0])
        return {"FINISHED"}
