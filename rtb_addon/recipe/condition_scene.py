"""A condition's scene: its parent, adjusted by its mappings, resolved into what renderers see."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .. import renderers
from ..errors import RecipeError
from ..layers import ERROR
from ..renderers.fidelity import TABLE, unsupported
from ..renderers.interface import Renderer
from ..renderers.native_lines import refused, scene_with
from ..scene.adjustments import Adjustments, NativeLine
from ..scene.document import Scene
from ..scene.render_scene import RenderScene
from ..scene.resolve import Resolved, SceneSettings, resolve

if TYPE_CHECKING:
    from ..conditions import Condition
    from . import Recipe
    from .options import RecipeOptions

FindFile = Callable[[str], Path | None]

# Our options as native lines call them.
_NATIVE_NAMES = {"samples": "sampleCount", "width": "width", "height": "height"}


def renderer_of(recipe: Recipe, name: str) -> Renderer:
    """Return a renderer by its name, looked up once for each recipe."""
    return recipe.once(("renderer", name), lambda: renderers.find(name))


def adjustments_of(
    recipe: Recipe, condition: Condition, find_file: FindFile, parent: Scene | None = None
) -> Adjustments:
    """Return the mappings that apply to a condition, its values filled in."""
    renderer, document = recipe.options_of(condition).renderer, parent or recipe.parent_of(condition)
    return recipe.mappings_of(condition).fill_in(condition, renderer, document, find_file)


def remodeled_parent(recipe: Recipe, condition: Condition) -> Scene:
    """Return a condition's parent scene as the remodeler's before_all leaves it."""
    parent = recipe.parent_of(condition)
    if (remodeler := recipe.remodeler) is None:
        return parent
    return recipe.lately(("before_all", parent), lambda: remodeler.changed("before_all", parent, recipe))


def resolve_condition(recipe: Recipe, condition: Condition, adjustments: Adjustments) -> Resolved:
    """Return a condition's neutral scene, in the handedness of the recipe."""
    options = recipe.options_of(condition)
    settings = SceneSettings(options.film, options.light_paths, options.camera, recipe.conventions.handedness)
    return resolve(_document_of(recipe, condition, adjustments), adjustments, settings, recipe.find_file)


def _document_of(recipe: Recipe, condition: Condition, adjustments: Adjustments) -> Scene:
    """Return a condition's document; mappings come between the remodeler's before and after."""
    parent = remodeled_parent(recipe, condition)
    if (remodeler := recipe.remodeler) is None:
        return parent
    adjusted = remodeler.changed("before_condition", parent, condition).adjusted(adjustments)
    return remodeler.changed("after_condition", adjusted, condition, adjustments.edits)


def lacks(renderer: str, scene: RenderScene) -> list[str]:
    """Return a sentence for everything in a scene that a renderer cannot render."""
    if not any(renderer in row for row in TABLE.values()):
        return []  # one of somebody else's, which must say so itself
    return unsupported(scene, renderer)


def refuse_layers(renderer: Renderer, options: RecipeOptions) -> None:
    """Raise where a renderer knows no layers and the options want some."""
    if set(options.layers) - {ERROR} and not hasattr(renderer, "layers"):
        wanted = ", ".join(options.layers)
        raise RecipeError(f"layers are {wanted}, the renderer {renderer.name} knows none, leave them empty")


def refusals(recipe: Recipe, condition: Condition, resolved: Resolved) -> list[RecipeError]:
    """Return what a renderer of ours cannot render of a condition's scene as its native lines change it."""
    name = recipe.options_of(condition).renderer
    if not any(name in row for row in TABLE.values()):
        return []
    lines, title = (
        remaining_lines(recipe, condition, resolved.extras),
        "Mitsuba" if name == "mitsuba" else name,
    )
    if wrong := list(refused(resolved.scene, lines, title)):
        return [*map(RecipeError, lacks(name, resolved.scene)), *wrong]
    return [*map(RecipeError, lacks(name, scene_with(resolved.scene, lines, title)))]


def remaining_lines(recipe: Recipe, condition: Condition, lines: Sequence[NativeLine]) -> list[NativeLine]:
    """Return a condition's native lines without those that its row or the command line overrules."""
    overruled = [_NATIVE_NAMES[name] for name in recipe.said_for(condition) if name in _NATIVE_NAMES]
    names = re.compile(rf"\b({'|'.join(overruled)})\b" if overruled else r"(?!)", re.IGNORECASE)
    return [line for line in lines if not names.search(re.split(r" [-+*/]?= ", line.text)[0])]
