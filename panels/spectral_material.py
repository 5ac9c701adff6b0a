"""Properties > Material: what a surface does with light of each wavelength."""

import bpy

from .spectra import SpectralPanel


class RTB_PT_spectral_material(SpectralPanel, bpy.types.Panel):
    """What the active material does with light of each wavelength"""

    bl_idname = "RTB_PT_spectral_material"
    bl_label = "Spectral Material"
    bl_context = "material"
    thing = "material"

    def draw_spectra(self, layout, settings):
        layout.prop(settings, "model")
        layout.prop(settings, "reflectance")
