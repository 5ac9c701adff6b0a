"""CIE daylight."""

import bpy

from .spectrum_verbs import AskingVerb


class RTB_OT_use_daylight(AskingVerb, bpy.types.Operator):
    """CIE daylight of a correlated colour temperature"""

    bl_idname = "rtb.use_daylight"
    bl_label = "Daylight"

    kelvin: bpy.props.FloatProperty(
        name="Temperature (K)", default=6504.0, min=4000.0, max=25000.0, step=10000, precision=0
    )
    asked = "kelvin"

    def text(self, context, owner):
        return f"daylight {self.kelvin:.6g}"
