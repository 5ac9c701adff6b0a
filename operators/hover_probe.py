"""Follow the pointer with the probe."""

import bpy

from . import pins
from .picture_places import pixel_at


class RTB_OT_hover_probe(bpy.types.Operator):
    """Show the spectrum of the pixel under the pointer"""

    bl_idname = "rtb.hover_probe"
    bl_label = "Probe Under Pointer"
    bl_options = {"INTERNAL"}

    def invoke(self, context, event):
        pixel = pixel_at(context, event.mouse_region_x, event.mouse_region_y)
        pins.hover(None if pixel is None else (pixel[0], (*pixel[1:], 1, 1)))
        return {"PASS_THROUGH"}
