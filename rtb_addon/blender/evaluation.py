"""
The scene as it renders: modifiers, visibility, instances and animation as Blender's own renderers get them.

Only a render engine is shown a scene in that state; so, for a moment, there is one that looks and renders
nothing. It works on a copy of the scene (which shares all objects), hence changes nothing that is kept.
Render handlers of other add-ons see a render go by.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import bpy

from ..errors import RecipeError

_ENGINE = "RTB_LOOK"
_Found = TypeVar("_Found")


def as_rendered(scene, read: Callable[[bpy.types.Depsgraph], _Found]) -> _Found:
    """Return what a function reads from the evaluated scene; it keeps no reference into Blender."""
    _finish_edits(scene)
    found: list[_Found] = []
    errors: list[BaseException] = []
    engine = _engine(read, found, errors)
    bpy.utils.register_class(engine)
    copy = scene.copy()
    try:
        layer = _view_layer(scene).name
        _render_little(copy, layer)
        bpy.ops.render.render(scene=copy.name, layer=layer)
    except RuntimeError as error:
        raise RecipeError(f"Blender cannot evaluate the scene {scene.name}: {_one_line(error)}") from error
    finally:
        bpy.data.scenes.remove(copy)
        bpy.utils.unregister_class(engine)
    if errors:
        raise errors[0]
    if not found:
        raise RecipeError(f"Blender is rendering, read the scene {scene.name} when that is done")
    return found[0]


def _one_line(error: Exception) -> str:
    return " ".join(str(error).removeprefix("Error: ").split()).rstrip(".")


def _engine(read: Callable, found: list, errors: list) -> type:
    class LookingEngine(bpy.types.RenderEngine):
        bl_idname = _ENGINE
        bl_label = "RenderToolbox Export"
        bl_use_preview = False

        def render(self, depsgraph) -> None:
            try:
                found.append(read(depsgraph))
            except BaseException as error:  # Blender would print and forget it
                errors.append(error)

    return LookingEngine


def _render_little(copy, layer: str) -> None:
    """Leave out what Blender does before and after an engine."""
    render, copy.view_layers[layer].use = copy.render, True
    render.engine = _ENGINE
    render.use_compositing = render.use_sequencer = render.use_multiview = False
    render.use_border = False


def _view_layer(scene):
    """Return the layer that the user sees, else the scene's first one that renders."""
    window = bpy.context.window
    if window is not None and window.scene == scene:
        return window.view_layer
    return next((layer for layer in scene.view_layers if layer.use), scene.view_layers[0])


def _finish_edits(scene) -> None:
    """Let meshes that are being edited know what has been done to them."""
    for object_ in scene.objects:
        if object_.mode == "EDIT":
            object_.update_from_editmode()
