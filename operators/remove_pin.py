"""Remove a pin."""

import bpy

from . import pins, viewing


class RTB_OT_remove_pin(bpy.types.Operator):
    """Remove the active pin, or all of them"""

    bl_idname = "rtb.remove_pin"
    bl_label = "Remove Pin"
    bl_options = {"INTERNAL"}

    all: bpy.props.BoolProperty(name="All", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return len(context.window_manager.rtb_pins) > 0

    def execute(self, context):
        if self.all:
            pins.clear()
            return {"FINISHED"}
        window_manager = context.window_manager
        window_manager.rtb_pins.remove(min(window_manager.rtb_active_pin, len(window_manager.rtb_pins) - 1))
        window_manager.rtb_active_pin = max(
            min(window_manager.rtb_active_pin, len(window_manager.rtb_pins) - 1), 0
        )
        viewing.redraw()
        return {"FINISHED"}
