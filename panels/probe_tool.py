"""The spectrum probe in the Image Editor's toolbar."""

import bpy

from ..operators.hover_probe import RTB_OT_hover_probe
from ..operators.probe import RTB_OT_probe
from . import overlay


class RTB_WT_probe(bpy.types.WorkSpaceTool):
    """The spectrum probe"""

    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "VIEW"
    bl_idname = "rtb.probe_tool"
    bl_label = "Spectrum Probe"
    bl_description = (
        "Show the spectrum under the pointer.\n"
        "Click or drag a box to keep it as a pin, with Shift compared to the active pin"
    )
    bl_icon = "ops.paint.eyedropper_add"
    bl_cursor = "EYEDROPPER"
    bl_keymap = (
        (RTB_OT_hover_probe.bl_idname, {"type": "MOUSEMOVE", "value": "ANY", "any": True}, None),
        (RTB_OT_probe.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),
        (
            RTB_OT_probe.bl_idname,
            {"type": "LEFTMOUSE", "value": "PRESS", "shift": True},
            {"properties": [("compare", True)]},
        ),
    )

    @staticmethod
    def draw_cursor(context, tool, xy):
        overlay.draw_plate(context, *xy)

    @staticmethod
    def draw_settings(context, layout, tool):
        layout.label(text="Click or drag to pin, Shift to compare")


def register() -> None:
    """Put the tool into the toolbar, after the one that samples colours."""
    bpy.utils.register_tool(RTB_WT_probe, after={"builtin.sample"}, separator=False)


def unregister() -> None:
    """Take it out."""
    bpy.utils.unregister_tool(RTB_WT_probe)
