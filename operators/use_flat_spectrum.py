"""The same at every wavelength."""

import bpy

from ..rtb_addon.blender.fields import is_number
from .spectrum_dialogs import SpectrumDialog


class RTB_OT_use_flat_spectrum(SpectrumDialog, bpy.types.Operator):
    """The same value at every wavelength"""

    bl_idname = "rtb.use_flat_spectrum"
    bl_label = "Flat"

    value: bpy.props.FloatProperty(name="Value", default=0.5, min=0.0, soft_max=1.0, precision=3)
    asked = "value"

    def begin(self, context, text):
        if is_number(text):
            self.value = float(text)

    def text(self, context, owner):
        return f"{self.value:.6g}"
