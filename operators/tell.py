"""Tell how a batch ended where Blender tells everything: in the status bar and the Info editor."""

import bpy

KINDS = (("INFO", "Info", "", 1), ("WARNING", "Warning", "", 2), ("ERROR", "Error", "", 3))


class RTB_OT_tell(bpy.types.Operator):
    """Tell something that was found out while nobody had pressed a button"""

    bl_idname = "rtb.tell"
    bl_label = "Render Recipe"
    bl_options = {"INTERNAL"}

    kind: bpy.props.EnumProperty(name="Kind", items=KINDS)
    sentence: bpy.props.StringProperty(name="Sentence")

    def invoke(self, context, event):
        # What an operator says is shown only when Blender's own event loop has called it.
        self.timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        self.cancel(context)
        self.report({self.kind}, self.sentence)
        return {"FINISHED"}

    def cancel(self, context):
        context.window_manager.event_timer_remove(self.timer)


def tell(kind: str, sentence: str) -> None:
    """Show a sentence in the status bar."""
    windows = bpy.context.window_manager.windows
    if windows and not bpy.app.background:
        with bpy.context.temp_override(window=windows[0]):
            bpy.ops.rtb.tell("INVOKE_DEFAULT", kind=kind, sentence=sentence)
