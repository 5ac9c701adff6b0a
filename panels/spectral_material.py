"""Properties > Material: what a surface does with light of each wavelength."""

import bpy

from .spectra import SpectralPanel
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_material(SpectralPanel, bpy.types.Panel):
    """What the active material does with light of each wavelength"""

    bl_idname = "RTB_PT_spectral_material"
    bl_label = "Spectral Material"
    bl_context = "material"
    thing = "material"

    def draw_spectra(self, layout, context, settings):
        layout.prop(settings, "model")
        draw_spectrum(layout, context, settings, "REFLECTANCE")
