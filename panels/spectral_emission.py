"""Properties > Data of a mesh: whether it shines, and how."""

import bpy

from ..rtb_addon.blender import light_words
from .light_numbers import draw_told
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_emission(bpy.types.Panel):
    """What light the active mesh sends out, from the side of its normals"""

    bl_idname = "RTB_PT_spectral_emission"
    bl_label = "Spectral Emission"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.mesh is not None and context.object is not None

    def draw_header(self, context):
        self.layout.prop(context.object.rtb, "emits", text="")

    def draw(self, context):
        layout, settings = self.layout, context.object.rtb
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.active = settings.emits
        wrong = draw_spectrum(layout, context, settings, "EMISSION")
        layout.prop(settings, "emission")
        layout.prop(settings, "amount")
        if settings.emits and not wrong:
            draw_told(layout, context, light_words.told_surface(settings, settings.emission, context.scene))
