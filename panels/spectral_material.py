"""Properties > Material: what a surface does with light of each wavelength."""

import bpy


class RTB_PT_spectral_material(bpy.types.Panel):
    """What the active material does with light of each wavelength"""

    bl_idname = "RTB_PT_spectral_material"
    bl_label = "Spectral Material"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        settings = context.material.rtb
        layout.prop(settings, "model")
        layout.prop(settings, "reflectance")
