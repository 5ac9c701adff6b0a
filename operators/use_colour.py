"""The spectrum that a colour stands for."""

import bpy

from .spectrum_dialogs import SpectrumDialog


class RTB_OT_use_colour(SpectrumDialog, bpy.types.Operator):
    """A smooth spectrum that shows a colour under D65"""

    bl_idname = "rtb.use_colour"
    bl_label = "Colour"

    colour: bpy.props.FloatVectorProperty(
        name="Colour", subtype="COLOR", default=(0.8, 0.2, 0.1), min=0.0, max=1.0, size=3
    )
    asked = "colour"

    def text(self, context, owner):
        from ..rtb_addon.blender.principled import in_words  # enabling need not wait for it

        return in_words(tuple(self.colour))
