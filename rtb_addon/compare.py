"""Renderer against renderer: how far the cubes of one recipe lie apart, in numbers, cubes and pictures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from .conditions import Condition
from .errors import RecipeError
from .files import write_text
from .montage import write_png
from .recipe import Recipe
from .spectra import FloatArray
from .spectral_image import SpectralImage
from .views import View

# What must be the same before radiances may be subtracted.
_WORDS = ("units", "handedness")
COLUMNS = ("condition", "ratio", "worst band [nm]", "its ratio", "relative rms", "largest", "noise")


@dataclass(frozen=True, eq=False)
class Comparison:
    """
    Two renderers' cubes of one condition.

    Parameters
    ----------
    condition : its name
    difference : the first radiance minus the second [W sr-1 m-2 nm-1]
    ratios : (bands,) array, the mean of the first over the mean of the second, band by band
    ratio : the same over all bands
    rms, largest : root mean square and largest difference over all pixels and bands, over the second's mean
    noise : the rms that the standard errors of both explain, None where a renderer did not say its own
    """

    condition: str
    difference: SpectralImage
    ratios: FloatArray
    ratio: float
    rms: float
    largest: float
    noise: float | None

    @property
    def worst_band(self) -> int:
        """The band whose ratio is farthest from 1."""
        return int(np.abs(self.ratios - 1).argmax())

    @property
    def numbers(self) -> tuple[str, ...]:
        """One row of the table."""
        worst = self.worst_band
        noise = "" if self.noise is None else f"{self.noise:.3g}"
        return (
            self.condition,
            f"{self.ratio:.5f}",
            f"{self.difference.bands.centres[worst]:g}",
            f"{self.ratios[worst]:.5f}",
            f"{self.rms:.3g}",
            f"{self.largest:.3g}",
            noise,
        )


def compare_cubes(condition: str, first: SpectralImage, second: SpectralImage) -> Comparison:
    """Return how far two cubes lie apart; raise where they are not of one kind."""
    _refuse_unlike(condition, first, second)
    one, two = first.radiance.astype(float), second.radiance.astype(float)
    apart, mean = one - two, two.mean()
    if not mean > 0:
        raise RecipeError(f"{condition} is black in the second rendering, nothing can be compared to it")
    with np.errstate(invalid="ignore", divide="ignore"):
        ratios = one.mean(axis=(0, 1)) / two.mean(axis=(0, 1))
    return Comparison(
        condition,
        replace(first, radiance=apart.astype(np.float32), standard_error=None),
        np.where(np.isfinite(ratios), ratios, 1.0),
        one.mean() / mean,
        float(np.sqrt((apart**2).mean()) / mean),
        float(np.abs(apart).max() / mean),
        _expected(first, second, mean),
    )


def compare_renderers(
    recipe: Recipe | Path | str, first: str, second: str, conditions: Sequence[str] | None = None
) -> Iterator[Comparison]:
    """
    Yield how two renderers' cubes of each condition lie apart, and write each difference.

    They go below comparisons/FIRST-SECOND/ of the recipe: a cube for each condition, at the end one picture
    of all, in false colour, and numbers.txt.

    Parameters
    ----------
    conditions : names of those to compare; None: all
    """
    recipe = recipe if isinstance(recipe, Recipe) else Recipe.load(recipe)
    folder, made = recipe.folder / "comparisons" / f"{first}-{second}", []
    for condition in recipe.conditions:
        if conditions is None or condition.name in conditions:
            cubes = [_cube(recipe.overridden(renderer=name), condition) for name in (first, second)]
            comparison = compare_cubes(condition.name, *cubes)
            words = {"difference": f"{first} minus {second}", "condition": condition.name}
            comparison.difference.with_attributes(words).save(folder / f"{condition.name}.exr")
            made.append(comparison)
            yield comparison
    if not made:
        raise RecipeError("no condition is left to compare, leave --conditions out for all")
    _write_summary(recipe, folder, made)


def table(comparisons: Sequence[Comparison]) -> str:
    """Return the numbers of some comparisons, a row each, with tabs between the cells."""
    return "".join("\t".join(row) + "\n" for row in (COLUMNS, *(each.numbers for each in comparisons)))


def _write_summary(recipe: Recipe, folder: Path, made: Sequence[Comparison]) -> None:
    view = View("difference")
    black = SpectralImage(np.zeros_like(made[0].difference.radiance), made[0].difference.bands)
    cells = [view.of(each.difference, black) for each in made]
    picture, _ = view.drawn(cells, recipe.montage)
    write_png(folder / f"{recipe.name}.png", picture)
    write_text(folder / "numbers.txt", table(made))


def _cube(recipe: Recipe, condition: Condition) -> SpectralImage:
    file, renderer = recipe.rendering_file(condition), recipe.options_of(condition).renderer
    if not file.is_file():
        raise RecipeError(
            f"{condition.name} is not rendered with {renderer} yet, render it with {renderer} first"
        )
    return SpectralImage.load(file)


def _refuse_unlike(condition: str, first: SpectralImage, second: SpectralImage) -> None:
    shapes = [image.radiance.shape for image in (first, second)]
    if shapes[0] != shapes[1] or not np.allclose(first.bands.edges, second.bands.edges, rtol=0, atol=1e-6):
        raise RecipeError(
            f"the two renderings of {condition} differ in size or bands, render one of them anew"
        )
    kinds = [image.band_kind for image in (first, second)]
    if kinds[0] != kinds[1]:
        raise RecipeError(f"the band values of {condition} are {kinds[0]} and {kinds[1]}, want one kind")
    for word in _WORDS:
        said = [image.attributes.get(word) for image in (first, second)]
        if said[0] != said[1]:
            raise RecipeError(f"{word} of {condition} are {said[0]} and {said[1]}, render one of them anew")


def _expected(first: SpectralImage, second: SpectralImage, mean: float) -> float | None:
    """Return the relative rms difference that two cubes' own noise explains."""
    try:
        noises = [float(image.attributes["noise"]) * image.radiance.mean() for image in (first, second)]
    except KeyError:
        return None
    return float(np.hypot(*noises) / mean)
