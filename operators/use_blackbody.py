"""The light of something that glows."""

import bpy

from .spectrum_verbs import AskingVerb


class RTB_OT_use_blackbody(AskingVerb, bpy.types.Operator):
    """The light of a black body that glows at a temperature"""

    bl_idname = "rtb.use_blackbody"
    bl_label = "Blackbody"

    kelvin: bpy.props.FloatProperty(
        name="Temperature (K)", default=2856.0, min=500.0, soft_max=12000.0, step=10000, precision=0
    )
    asked = "kelvin"

    def text(self, context, owner):
        return f"blackbody {self.kelvin:.6g}"
