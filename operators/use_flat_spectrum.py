"""The same at every wavelength."""

import bpy

from .spectrum_verbs import AskingVerb


class RTB_OT_use_flat_spectrum(AskingVerb, bpy.types.Operator):
    """The same value at every wavelength"""

    bl_idname = "rtb.use_flat_spectrum"
    bl_label = "Flat"

    value: bpy.props.FloatProperty(name="Value", default=0.5, min=0.0, soft_max=1.0, precision=3)
    asked = "value"

    def text(self, context, owner):
        return f"{self.value:.6g}"
