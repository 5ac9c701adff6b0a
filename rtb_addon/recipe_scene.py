"""A condition's scene: its parent, adjusted by its mappings, resolved into what renderers see."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from .renderers.fidelity import fidelity
from .scene.adjustments import Adjustments
from .scene.render_scene import RenderScene
from .scene.resolve import Resolved, SceneSettings, resolve

if TYPE_CHECKING:
    from .conditions import Condition
    from .recipe import Recipe

FindFile = Callable[[str], Path | None]


def adjustments_of(recipe: Recipe, condition: Condition, find_file: FindFile) -> Adjustments:
    """Return the mappings that apply to a condition, its values filled in."""
    renderer, document = recipe.options_of(condition).renderer, recipe.parent_of(condition)
    return recipe.mappings_of(condition).fill_in(condition, renderer, document, find_file)


def resolve_condition(recipe: Recipe, condition: Condition, adjustments: Adjustments) -> Resolved:
    """Return a condition's neutral scene, in the handedness of the recipe."""
    options = recipe.options_of(condition)
    settings = SceneSettings(options.film, options.light_paths, options.camera, recipe.conventions.handedness)
    return resolve(recipe.parent_of(condition), adjustments, settings, recipe.find_file)


def unsupported(renderer: str, scene: RenderScene) -> list[str]:
    """Return the words of the vocabulary that a scene uses and a renderer lacks."""
    return [word for word in features(scene) if fidelity(renderer, word).level == "absent"]


def features(scene: RenderScene) -> list[str]:
    """Return the words of the vocabulary that a scene uses."""
    used = {f"camera {scene.camera.projection}"}
    used |= {f"material {scene.materials[shape.material].model}" for shape in scene.shapes}
    used |= {f"light {light.kind}" for light in scene.lights}
    used |= {f"texture {texture.kind}" for texture in scene.textures.values()}
    if any(shape.emission is not None for shape in scene.shapes):
        used.add("light area")
    if scene.environment is not None:
        used.add(f"light {scene.environment.kind}")
    return sorted(used)
