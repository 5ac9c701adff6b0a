"""One condition: its rendering found done, or made."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..conditions import Condition
from ..errors import RecipeError
from ..files import temporary_prefix
from ..layers import Layers
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
from ..spectral_image import SpectralImage
from . import records
from .beside import layers_of, render_options
from .keys import Key, key_of, plain

SCRATCH = ".unfinished"  # where cubes are written before they take their place


@dataclass(frozen=True)
class Rendering:
    """
    A condition's radiance cube on disk.

    Parameters
    ----------
    condition : its name
    file : the cube, float32 OpenEXR [W sr-1 m-2 nm-1]
    record : how it was made
    new : whether it was rendered now, rather than found done
    """

    condition: str
    file: Path
    record: Mapping[str, Any]
    new: bool

    @property
    def image(self) -> SpectralImage:
        """The cube's content."""
        return SpectralImage.load(self.file)


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
    return _saved(image, layers, recipe, condition, record)


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


def _saved(
    image: SpectralImage, layers: Layers | None, recipe: Recipe, condition: Condition, record: dict[str, Any]
) -> Rendering:
    """
    Put a cube, its record and its layers into the folder, in the recipe's units.

    The cube is written outside renderings/ and moved in, the others go first: whatever moment a
    process is killed in, a cube is there whole with its record, or it is not there.
    """
    file, factor = recipe.rendering_file(condition), recipe.conventions.factor
    image = image.scaled(factor)
    record = {**record, "factor": image.factor, "renderer says": dict(image.attributes)}
    aside = _scratch_folder(recipe.folder, file.parent) / (temporary_prefix(os.getpid()) + file.name)
    try:
        image.with_attributes(records.attributes(record)).save(aside)
        if layers is not None:
            layers.scaled(factor).save(recipe.layers_file(condition))
        records.write(recipe.record_file(condition), record)
        aside.replace(file)
    except OSError as error:
        raise RecipeError(f"cannot write {file}: {error.strerror}") from error
    finally:
        aside.unlink(missing_ok=True)
    return Rendering(condition.name, file, record, True)


def _scratch_folder(recipe: Path, target: Path) -> Path:
    """Return a folder of unfinished cubes on the disk of the finished ones."""
    target.mkdir(parents=True, exist_ok=True)
    same_disk = target.stat().st_dev == recipe.stat().st_dev
    folder = (recipe if same_disk else target) / SCRATCH
    folder.mkdir(exist_ok=True)
    return folder
