"""Blender's own panels that make sense with our engine: sizes, cameras, lamps, slots of materials."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

# Panels for any engine say this; those of other features that we do not have begin with these.
_ANY = "BLENDER_RENDER"
_WITHOUT = (
    "NODE_",  # copies in the node editor, which share the set of the panel that they come from
    "RENDER_PT_freestyle",
    "VIEWLAYER_PT_freestyle",
    "MATERIAL_PT_freestyle",
    "RENDER_PT_stereoscopy",
    "RENDER_PT_output_views",
    "RENDER_PT_gpencil",
    "RENDER_PT_grease_pencil",
    "RENDER_PT_simplify_greasepencil",
    "DATA_PT_camera_stereoscopy",
    "DATA_PT_light",
    "DATA_PT_preview",
    "PARTICLE_PT",
    "TEXTURE_PT",
)
# Eevee's panels of what we render too.
_WITH = (
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_surface",
    "EEVEE_WORLD_PT_surface",
    "DATA_PT_EEVEE_light",
    "DATA_PT_camera_dof",
    "DATA_PT_camera_dof_aperture",
)


def add_to_panels(engine: str) -> None:
    """Let panels serve an engine."""
    for panel in _panels():
        panel.COMPAT_ENGINES.add(engine)


def remove_from_panels(engine: str) -> None:
    """Let all panels be as they were."""
    for panel in bpy.types.Panel.__subclasses__():
        if engine in getattr(panel, "COMPAT_ENGINES", ()):
            panel.COMPAT_ENGINES.remove(engine)


def _panels() -> Iterator[type]:
    for panel in bpy.types.Panel.__subclasses__():
        name, engines = panel.__name__, getattr(panel, "COMPAT_ENGINES", ())
        if name in _WITH or (_ANY in engines and not name.startswith(_WITHOUT)):
            yield panel
