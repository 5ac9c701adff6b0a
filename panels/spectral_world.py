"""Properties > World: light from all around."""

import bpy

from ..rtb_addon.blender import light_words
from .light_numbers import draw_told
from .renderer_words import draw_renderers
from .sentences import draw_sentences
from .spectra import SpectralPanel
from .spectral_material import draw_image
from .spectrum_field import draw_spectrum

FEATURES = {
    "CONSTANT": [("light environment", "Light from everywhere")],
    "IMAGE": [("light environment picture", "An image all around")],
    "SUNSKY": [("light sunsky", "Sun and sky")],
}
PICTURES = "RGB becomes smooth spectra; bands of an EXR stay as they are"


class RTB_PT_spectral_world(SpectralPanel, bpy.types.Panel):
    """The spectrum of light from all around; a world without spectra is dark"""

    bl_idname = "RTB_PT_spectral_world"
    bl_label = "Spectral World"
    bl_context = "world"
    thing = "world"

    def draw_spectra(self, layout, context, settings):
        layout.prop(settings, "kind")
        if settings.kind == "IMAGE":
            draw_image(layout, settings, "image")
            layout.prop(settings, "rotation")
            draw_sentences(layout, [PICTURES], context.region.width)
        if settings.kind == "SUNSKY":
            for name in ("turbidity", "elevation", "azimuth"):
                layout.prop(settings, name)
        else:
            wrong = draw_spectrum(layout, context, settings, "WORLD")
            if settings.kind == "CONSTANT":
                layout.prop(settings, "measure")
            layout.prop(settings, "amount")
            if settings.kind == "CONSTANT" and not wrong:
                told = light_words.told_surface(settings, settings.measure, context.scene)
                draw_told(layout, context, told)
        draw_renderers(layout, context, FEATURES[settings.kind])
