"""Properties > Data of a lamp: the spectrum of its light, and how much of it."""

import bpy

from ..rtb_addon.blender import light_words
from .light_numbers import draw_told
from .spectra import SpectralPanel
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_light(SpectralPanel, bpy.types.Panel):
    """The spectrum of the active lamp, and how much light it sends out"""

    bl_idname = "RTB_PT_spectral_light"
    bl_label = "Spectral Light"
    bl_context = "data"
    thing = "light"

    def draw_spectra(self, layout, context, settings):
        wrong = draw_spectrum(layout, context, settings, "LIGHT")
        layout.prop(settings, "measure")
        if settings.measure == "WATTS":
            layout.prop(context.light, "energy")
        else:
            layout.prop(settings, "amount")
        if settings.measure == "LUX" and context.light.type != "SUN":
            layout.prop(settings, "distance")
        if not wrong:
            draw_told(layout, context, light_words.told(context.light, context.scene))
