"""One condition: its rendering found done, or made."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from ..conditions import Condition
from ..errors import RecipeError
from ..recipe import Recipe
from ..recipe.condition_scene import (
    adjustments_of,
    lacks,
    refuse_layers,
    remaining_lines,
    remodeled_parent,
    renderer_of,
    resolve_condition,
)
from ..recipe.remodeler import Hook, remodeled
from ..renderers.interface import Report
from . import records
from .beside import layers_of, render_options
from .keys import Key, key_of, plain
from .saving import Rendering, Unsaved


def render_condition(
    recipe: Recipe | Path | str,
    name: str,
    report: Report = lambda _: None,
    *,
    threads: int = 1,
    gpu: bool = False,
    fresh: bool = False,
    remodelers: Sequence[Hook] = (),
    trust: bool = False,
) -> Rendering:
    """
    Render one condition of a recipe, or find it done; safe to do twice, or in two processes.

    Parameters
    ----------
    recipe : a recipe, or its folder
    report : called between passes with the fraction done; may raise Cancelled
    threads : processor threads to use
    gpu : render on a graphics card, if the renderer can
    fresh : render even what is done
    remodelers : functions that change the scene, instead of the folder's remodeler.py
    trust : run the folder's remodeler.py even if the user has not agreed to that yet
    """
    recipe = recipe if isinstance(recipe, Recipe) else Recipe.load(recipe)
    recipe = remodeled(recipe, remodelers, trust)
    made = rendered(recipe, name, report, threads=threads, gpu=gpu, fresh=fresh)
    return made.save() if isinstance(made, Unsaved) else made


def rendered(
    recipe: Recipe, name: str, report: Report, *, threads: int = 1, gpu: bool = False, fresh: bool = False
) -> Rendering | Unsaved:
    """Render one condition of a recipe, which is then still to be saved, or find it done."""
    condition = recipe.conditions[name]
    key = key_of(recipe, condition)
    if not fresh and (done := found(recipe, condition, key)) is not None:
        return done
    began = time.monotonic()
    key = _as_remodeled(recipe, condition, key)
    resolved = resolve_condition(recipe, condition, key.adjustments)
    options = recipe.options_of(condition)
    if missing := lacks(options.renderer, resolved.scene):
        raise RecipeError(missing[0])
    extras = remaining_lines(recipe, condition, resolved.extras)
    renderer = renderer_of(recipe, options.renderer)
    refuse_layers(renderer, options)
    folder = recipe.scenes_folder / options.renderer
    native = renderer.translate(resolved.scene, extras, folder, name)
    ready = time.monotonic()
    how = render_options(options, threads, gpu)
    image = renderer.render(native, how, report)
    ended = time.monotonic()
    layers = layers_of(renderer, native, image, options.layers, how, report)
    seconds = {"seconds": time.monotonic() - began, "seconds rendering": ended - ready}
    record = records.record(recipe, condition, key, resolved.warnings, seconds)
    return Unsaved.of(recipe, condition, image, layers, record)


def _as_remodeled(recipe: Recipe, condition: Condition, key: Key) -> Key:
    """Return a key with the mappings as the remodeled parent scene fills them in."""
    if recipe.remodeler is None:
        return key
    parent = remodeled_parent(recipe, condition)
    adjustments = adjustments_of(recipe, condition, recipe.find_file, parent)
    return key._replace(adjustments=adjustments, applied=plain(adjustments, recipe.folder))


def found(recipe: Recipe, condition: Condition, key: Key) -> Rendering | None:
    """Return the rendering of a key if it is there and whole."""
    file = recipe.rendering_file(condition)
    if not file.is_file() or records.key_in(file) != key.digest:
        return None
    return Rendering(condition.name, file, records.read(recipe.record_file(condition)), False)
