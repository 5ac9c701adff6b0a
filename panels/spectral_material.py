"""Properties > Material: what a surface does with light of each wavelength."""

from __future__ import annotations

import bpy

from ..operators.use_metal import RTB_OT_use_metal
from ..rtb_addon.blender.material_words import is_typed, metal_of, takes_texture, texture_of, words_of
from ..rtb_addon.scene.vocabulary import MATERIALS
from .material_presets import RTB_PT_material_presets
from .renderer_words import draw_renderers, features
from .spectra import SpectralPanel
from .spectrum_field import draw_spectrum


class RTB_PT_spectral_material(SpectralPanel, bpy.types.Panel):
    """What the active material does with light of each wavelength"""

    bl_idname = "RTB_PT_spectral_material"
    bl_label = "Spectral Material"
    bl_context = "material"
    thing = "material"

    def draw_presets(self, header):
        RTB_PT_material_presets.draw_panel_header(header)

    def draw_spectra(self, layout, context, settings):
        layout.prop(settings, "model")
        if settings.model == "metal":
            layout.operator(
                RTB_OT_use_metal.bl_idname, text=metal_of(settings) or "Choose Metal…", icon="VIEWZOOM"
            )
        for number, (name, parameter) in enumerate(MATERIALS[settings.model].items()):
            own = words_of(name).name
            if takes_texture(name, parameter.kind) and getattr(settings, texture_of(own)).kind != "NONE":
                layout.label(text=f"{words_of(name).label} from a texture")
            elif is_typed(parameter.kind):
                draw_spectrum(layout, context, settings, own.upper(), flat=number == 0)
            else:
                layout.prop(settings, own)
        draw_detail(layout, context, settings)
        draw_renderers(layout, context, list(features(settings)))


def draw_detail(layout, context, settings) -> None:
    """Draw what varies over the surface: textures, relief, opacity."""
    header, body = layout.panel("RTB_PT_surface_detail", default_closed=True)
    header.label(text="Surface Detail")
    if body is None:
        return
    for name, parameter in MATERIALS[settings.model].items():
        if takes_texture(name, parameter.kind):
            own = words_of(name).name
            draw_texture(body, context, getattr(settings, texture_of(own)), words_of(name).label, own)
    body.prop(settings, "detail")
    if settings.detail != "NONE":
        draw_image(body, settings, "detail_image")
    if settings.detail == "bumpmap":
        body.prop(settings, "detail_scale")
    if settings.model != "mask":
        body.prop(settings, "opacity")


def draw_texture(layout, context, texture, label: str, own: str) -> None:
    """Draw what stands for a parameter."""
    layout.prop(texture, "kind", text=label)
    if texture.kind == "bitmap":
        draw_image(layout, texture, "image")
        layout.prop(texture, "wrap")
        layout.prop(texture, "offset")
        layout.prop(texture, "scale")
    elif texture.kind == "checkerboard":
        for part in ("even", "odd"):
            draw_spectrum(layout, context, texture, f"{own}_{part}".upper(), flat=False)
        layout.prop(texture, "checks")
        layout.prop(texture, "offset")


def draw_image(layout, owner, name: str) -> None:
    """Draw the choice of an image, with a button that opens a file."""
    layout.template_ID(owner, name, open="image.open")
