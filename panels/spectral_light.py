"""Properties > Data of a lamp: the spectrum of its light. How much of it stays in Blender's own panel."""

import bpy

from .spectra import SpectralPanel
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_light(SpectralPanel, bpy.types.Panel):
    """The spectrum of the active lamp"""

    bl_idname = "RTB_PT_spectral_light"
    bl_label = "Spectral Light"
    bl_context = "data"
    thing = "light"

    def draw_spectra(self, layout, context, settings):
        draw_spectrum(layout, context, settings, "LIGHT")
