"""Properties > Render: how RenderToolbox renders, for its engine and for recipes alike."""

import bpy

from ..operators.render_engine import ENGINE
from .sentences import draw_sentences

HINT = "Renders the active condition; the picture goes through the view transform, the cube is kept"
BANDS = {"bands_count": "Bands", "bands_start": "First (nm)", "bands_step": "Width (nm)"}


class RTB_PT_render_settings(bpy.types.Panel):
    """How RenderToolbox renders"""

    bl_idname = "RTB_PT_render_settings"
    bl_label = "RenderToolbox"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    # Panels of extensions stand below all of Blender's, but those without header above them.
    bl_options = {"HIDE_HEADER"}

    def draw(self, context):
        scene = context.scene
        ours = scene.render.engine == ENGINE
        # Whoever closes it for one engine has not closed it for the other.
        header, body = self.layout.panel(f"{self.bl_idname}_{ours}", default_closed=not ours)
        header.label(text=self.bl_label)
        if body is None:
            return
        body.use_property_split = True
        body.use_property_decorate = False
        if ours:
            draw_sentences(body, [HINT], context.region.width)
        draw_settings(body, scene.rtb)


def draw_settings(layout, settings) -> None:
    """Draw what is often changed, and below what seldom is."""
    layout.prop(settings, "renderer")
    column = layout.column(align=True)
    column.prop(settings, "samples")
    column.prop(settings, "until_error")
    column = layout.column(align=True)
    for name, label in BANDS.items():
        column.prop(settings, name, text=label)
    header, layers = layout.panel("RTB_PT_render_settings_layers", default_closed=True)
    header.label(text="Layers")
    if layers is not None:
        column = layers.column(align=True)
        column.use_property_split = False
        column.prop(settings, "layers")
    header, advanced = layout.panel("RTB_PT_render_settings_advanced", default_closed=True)
    header.label(text="Advanced")
    if advanced is not None:
        column = advanced.column(align=True)
        column.prop(settings, "integrator")
        column.prop(settings, "depth")
        for name in ("seed", "filter", "band_kind"):
            advanced.prop(settings, name)
