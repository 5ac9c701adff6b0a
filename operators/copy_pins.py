"""Copy the pins to the clipboard."""

import bpy

from . import pins


class RTB_OT_copy_pins(bpy.types.Operator):
    """Copy all pins to the clipboard as CSV: what they are, then a row for each wavelength"""

    bl_idname = "rtb.copy_pins"
    bl_label = "Copy Pins"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return len(context.window_manager.rtb_pins) > 0

    def execute(self, context):
        kept = context.window_manager.rtb_pins
        context.window_manager.clipboard = pins.table(kept)
        self.report({"INFO"}, f"{len(kept)} pin{'s' * (len(kept) != 1)} copied")
        return {"FINISHED"}
