"""What a recipe wants beside a rendering: depth, normals, albedo, standard errors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..errors import RecipeError
from ..layers import ERROR, Layers
from ..recipe.options import RecipeOptions
from ..renderers.interface import RenderOptions, Report
from ..spectral_image import SpectralImage


def render_options(options: RecipeOptions, threads: int, gpu: bool = False) -> RenderOptions:
    """Return what a recipe says of how to render that no native scene holds."""
    return RenderOptions(threads, options.until_seconds, options.until_error, ERROR in options.layers, gpu)


def layers_of(
    renderer: Any,
    native: Path,
    image: SpectralImage,
    names: Sequence[str],
    options: RenderOptions,
    report: Report,
) -> Layers | None:
    """
    Return the layers that a recipe wants in SI units, None when it wants none.

    Parameters
    ----------
    image : the rendering in SI units, with its standard errors where they are wanted
    """
    if not names:
        return None
    others = [name for name in names if name != ERROR]
    found = renderer.layers(native, others, options, report) if others else Layers({})
    if ERROR not in names:
        return found
    if image.standard_error is None:
        raise RecipeError(f"the renderer {renderer.name} knows no standard errors, take them out of layers")
    return replace(found, planes={**found.planes, ERROR: image.standard_error}, bands=image.bands)
