"""RenderToolbox among Blender's render engines: Render Image renders the active condition, in spectra."""

from __future__ import annotations

import bpy

from ..rtb_addon.errors import RecipeError, RenderingError
from .compatible_panels import add_to_panels, remove_from_panels

ENGINE = "RENDERTOOLBOX"


class RTB_RE_engine(bpy.types.RenderEngine):
    """Renders the active condition in a process of its own, and keeps its radiance cube"""

    bl_idname = ENGINE
    bl_label = "RenderToolbox"
    bl_use_preview = False
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    def render(self, depsgraph):
        from .engine_rendering import EngineRendering  # enabling need not wait for what it brings

        try:
            EngineRendering(self, depsgraph).run()
        except (RecipeError, RenderingError) as error:
            self.report({"ERROR"}, str(error))
            self.error_set(str(error))


def register() -> None:
    """Let Blender choose this engine, and its panels serve it."""
    bpy.utils.register_class(RTB_RE_engine)
    add_to_panels(ENGINE)


def unregister() -> None:
    """Take it back."""
    remove_from_panels(ENGINE)
    bpy.utils.unregister_class(RTB_RE_engine)
