"""Properties > Data of a lamp: the spectrum of its light, and how much of it."""

import bpy

from ..rtb_addon.blender import light_words
from .numbers import draw_numbers
from .sentences import draw_sentences
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


def draw_told(layout, context, found) -> None:
    """Draw what is known of a light, or why there is none."""
    draw_sentences(layout, [found.sentence] if found.sentence else [], context.region.width, alert=True)
    column = layout.column()
    column.active = False
    # As many rows as there will be: a panel that grows by itself lies over the next one for a while.
    draw_numbers(column, found.rows or [("", "")] * light_words.ROWS * (not found.sentence))
