"""Pictures of a recipe's renderings: one condition or all of them, seen in some way, and what lies where."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from .conditions import Condition
from .errors import RecipeError
from .files import replacing
from .kept_cubes import KeptCubes, Source
from .recipe import Recipe
from .recipe.options import MontageOptions
from .tiles import Tiles
from .views import View

MOST_PIXELS = 2_500_000  # of a picture; more than a screen shows only costs Blender time
NOTHING = {"difference": "not comparable", "error": "no standard errors"}  # to be seen in a view


@dataclass(frozen=True)
class Look:
    """
    What a picture is wanted of.

    Parameters
    ----------
    folder : of the recipe
    output : the picture's file
    renderer : instead of the recipe's own
    condition : the one to show; empty: all of them
    other : the condition that differences are to
    view : words of a View
    grid : columns and fill of the montage, instead of the recipe's
    """

    folder: str
    output: str
    renderer: str = ""
    condition: str = ""
    other: str = ""
    view: Mapping[str, Any] = field(default_factory=dict)
    grid: Mapping[str, Any] = field(default_factory=dict)


def draw_look(look: Look, kept: KeptCubes) -> dict[str, Any]:
    """Draw a picture into its file, and return what is where in it in words that JSON can write."""
    view = View(**look.view)
    recipe = Recipe.load(look.folder).overridden(renderer=look.renderer or None)
    conditions = [_condition(recipe, look.condition)] if look.condition else list(recipe.conditions)
    names = [each.name for each in conditions]
    sources = {each.name: _source(recipe, each, view, look.other) for each in conditions}
    # The newest one tells what size all have: what was rendered before in another one is out of date.
    first = kept.cube(_newest([source.file for source in sources.values()]))
    height, width, _ = first.radiance.shape
    by, options = _reduction(len(names) * height * width), _arrangement(recipe, look)
    cells, absent = _cells(sources, kept, view, by, (height, width))
    pixels, full = view.drawn([cells.get(name) for name in names], options)
    _write_picture(Path(look.output), pixels)
    return {
        "file": look.output,
        "folder": look.folder,
        "name": recipe.name,
        "renderer": sources[names[0]].file.parent.name,
        "tiles": Tiles.of(names, (width, height), options, by).to_words(),
        "full": full,
        "view": dataclasses.asdict(view),
        "other": look.other,
        "bands": first.bands.centres.tolist(),
        "there": list(cells),
        "absent": absent,
    }


def file_of(recipe: Recipe, name: str) -> Path:
    """Return where a condition's cube is, or will be."""
    return recipe.rendering_file(_condition(recipe, name))


def _condition(recipe: Recipe, name: str) -> Condition:
    condition = next((each for each in recipe.conditions if each.name == name), None)
    if condition is None:
        raise RecipeError(f"{recipe.folder} holds no condition {name}, press Render Recipe")
    return condition


def _source(recipe: Recipe, condition: Condition, view: View, other: str) -> Source:
    """Return the files that a view of a condition needs."""
    return Source(
        recipe.rendering_file(condition),
        file_of(recipe, other) if view.kind == "difference" and other else None,
        recipe.layers_file(condition) if view.kind == "error" else None,
    )


def _newest(files: Sequence[Path]) -> Path:
    """Return the file that was written last, the first one where there is none."""
    return max(files, key=lambda file: file.stat().st_mtime_ns if file.is_file() else 0)


def _arrangement(recipe: Recipe, look: Look) -> MontageOptions:
    """Return how a picture is put together: one cube alone by the montage's tone map and scale."""
    if look.condition:
        return replace(recipe.montage, columns=1)
    return replace(recipe.montage, **look.grid)


def _cells(
    sources: Mapping[str, Source], kept: KeptCubes, view: View, by: int, size: tuple[int, int]
) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """
    Return what is to be seen of conditions, and in a word or two why nothing is of others.

    Parameters
    ----------
    size : height and width of the cubes that can be shown side by side [pixels]
    """
    cells: dict[str, np.ndarray] = {}
    absent: dict[str, str] = {}
    wrong: list[RecipeError] = []
    for name, source in sources.items():
        if not source.file.is_file():
            absent[name] = "not rendered"
            continue
        try:
            part = kept.part(source, view, by)
        except RecipeError as error:
            wrong.append(error)
            absent[name] = NOTHING.get(view.kind, "not readable")
            continue
        if part.size == size:
            cells[name] = part.pixels
        else:
            absent[name] = "of another size"
    if wrong and not cells:
        raise wrong[0]
    return cells, absent


def _write_picture(path: Path, pixels: np.ndarray) -> None:
    """Write a picture in the form that Blender reads soonest: it does so where its window waits."""
    from PIL import Image

    with replacing(path) as temporary:
        Image.fromarray(pixels).save(temporary, format="TIFF")


def _reduction(pixels: int) -> int:
    """Return how many pixels across and down become one, so that a picture is not larger than need be."""
    by = 1
    while pixels > MOST_PIXELS * by * by:
        by += 1
    return by
