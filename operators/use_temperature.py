"""The light of a temperature: CIE daylight, or something that glows."""

import bpy

from .spectrum_dialogs import SpectrumDialog


class OfTemperature(SpectrumDialog):
    """A verb that asks for a temperature, and writes a word and that number."""

    asked = "kelvin"

    def begin(self, context, text):
        word, _, number = text.partition(" ")
        if word.lower() == self.word and number.strip().replace(".", "", 1).isdecimal():
            self.kelvin = float(number)

    def text(self, context, owner):
        return f"{self.word} {self.kelvin:.6g}"


class RTB_OT_use_daylight(OfTemperature, bpy.types.Operator):
    """CIE daylight of a correlated colour temperature"""

    bl_idname = "rtb.use_daylight"
    bl_label = "Daylight"
    word = "daylight"

    kelvin: bpy.props.FloatProperty(
        name="Temperature (K)", default=6504.0, min=4000.0, max=25000.0, step=10000, precision=0
    )


class RTB_OT_use_blackbody(OfTemperature, bpy.types.Operator):
    """The light of a black body that glows at a temperature"""

    bl_idname = "rtb.use_blackbody"
    bl_label = "Blackbody"
    word = "blackbody"

    kelvin: bpy.props.FloatProperty(
        name="Temperature (K)", default=2856.0, min=500.0, soft_max=12000.0, step=10000, precision=0
    )
