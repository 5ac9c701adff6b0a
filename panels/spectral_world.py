"""Properties > World: light from all around."""

import bpy

from .spectra import SpectralPanel
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_world(SpectralPanel, bpy.types.Panel):
    """The spectrum of light from all around; a world without spectra is dark"""

    bl_idname = "RTB_PT_spectral_world"
    bl_label = "Spectral World"
    bl_context = "world"
    thing = "world"

    def draw_spectra(self, layout, context, settings):
        draw_spectrum(layout, context, settings, "WORLD")
        layout.prop(settings, "amount")
