"""What light comes from a part of a picture: its spectrum, and what observers and cones make of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

import numpy as np

from .colorimetry import xyz
from .colour_difference import delta_e, lab, white
from .errors import RecipeError
from .observers import lms
from .spectra import FloatArray
from .spectral_image import SpectralImage


class Region(NamedTuple):
    """A rectangle of pixels, row 0 on top."""

    left: int
    top: int
    width: int = 1
    height: int = 1

    @classmethod
    def between(cls, one: tuple[int, int], other: tuple[int, int]) -> Region:
        """Return the rectangle that has two pixels (column, row) in opposite corners."""
        (left, right), (top, bottom) = sorted((one[0], other[0])), sorted((one[1], other[1]))
        return cls(left, top, right - left + 1, bottom - top + 1)

    @property
    def pixels(self) -> int:
        """How many it holds."""
        return self.width * self.height


@dataclass(frozen=True)
class Probe:
    """
    What light comes from a region of a condition.

    Parameters
    ----------
    condition : its name
    region : where
    wavelengths : of the bands' centres [nm]
    radiance : mean of the region's pixels in each band [W sr-1 m-2 nm-1]
    standard_error : of that mean, from how the pixels differ; 0 for one pixel
    luminance, luminance_error : mean and its standard error [cd m-2]
    xyz : CIE 1931 tristimulus values [cd m-2]
    lms : what the cones catch, by the fundamentals of CIE 170-1:2006 for 2 degrees [W sr-1 m-2]
    white : luminance of the brightest pixel of the condition [cd m-2]
    renderer : that has rendered it, where the cube says so
    """

    condition: str
    region: Region
    wavelengths: tuple[float, ...]
    radiance: tuple[float, ...]
    standard_error: tuple[float, ...]
    luminance: float
    luminance_error: float
    xyz: tuple[float, ...]
    lms: tuple[float, ...]
    white: float
    renderer: str = ""

    @classmethod
    def from_words(cls, words: Mapping[str, Any]) -> Probe:
        """Return what to_words() wrote."""
        lists = {name: tuple(value) for name, value in words.items() if isinstance(value, list)}
        return cls(**{**words, **lists, "region": Region(*words["region"])})

    def to_words(self) -> dict[str, Any]:
        """Return it as JSON can write it."""
        return asdict(self)

    @property
    def xy(self) -> tuple[float, float]:
        """CIE 1931 chromaticity; of no light that of equal energy."""
        whole = sum(self.xyz)
        return (self.xyz[0] / whole, self.xyz[1] / whole) if whole > 0 else (1 / 3, 1 / 3)


class Difference(NamedTuple):
    """
    How a second region differs from a first one.

    Parameters
    ----------
    delta_e : CIEDE2000; white is D65 as bright as the brightest pixel of the first region's condition
    cone_contrast : of L, M and S: second over first, minus 1
    """

    delta_e: float
    cone_contrast: tuple[float, ...]


def probed(cube: SpectralImage, condition: str, region: Region, white: float | None = None) -> Probe:
    """
    Return what light comes from a region of a condition's cube.

    Parameters
    ----------
    white : luminance of the cube's brightest pixel, where that is known already [cd m-2]
    """
    pixels = _pixels(cube, region)
    tristimulus = xyz(SpectralImage(pixels[None], cube.bands))[0]
    mean = pixels.mean(axis=0)
    return Probe(
        condition,
        region,
        wavelengths=_listed(cube.bands.centres),
        radiance=_listed(mean),
        standard_error=_listed(_error_of_mean(pixels)),
        luminance=float(tristimulus[:, 1].mean()),
        luminance_error=float(_error_of_mean(tristimulus[:, 1])),
        xyz=_listed(tristimulus.mean(axis=0)),
        lms=_listed(lms(mean, cube.bands)),
        white=brightest(cube) if white is None else white,
        renderer=cube.attributes.get("renderer", ""),
    )


def brightest(cube: SpectralImage) -> float:
    """Return the luminance of the brightest pixel [cd m-2]."""
    return float(xyz(cube)[..., 1].max())


def difference(first: Probe, second: Probe) -> Difference:
    """Return how a second region differs from a first one."""
    contrast = tuple(b / a - 1 if a > 0 else float("nan") for a, b in zip(first.lms, second.lms, strict=True))
    if not first.white > 0:
        return Difference(0.0, contrast)
    colours = (lab(np.array(each.xyz), white(first.white)) for each in (first, second))
    return Difference(float(delta_e(*colours)), contrast)


def _pixels(cube: SpectralImage, region: Region) -> FloatArray:
    """Return a region's spectra in double precision, (pixels, bands)."""
    height, width, bands = cube.radiance.shape
    right, bottom = region.left + region.width, region.top + region.height
    if min(region) < 0 or region.pixels < 1 or right > width or bottom > height:
        raise RecipeError(f"a picture of {width} x {height} pixels has no region {tuple(region)}")
    part = cube.radiance[region.top : bottom, region.left : right]
    return part.reshape(-1, bands).astype(float)


def _error_of_mean(values: FloatArray) -> FloatArray:
    """Return the standard error of the mean along the first axis, 0 for a single value."""
    count = len(values)
    return values.std(axis=0, ddof=1) / np.sqrt(count) if count > 1 else np.zeros(values.shape[1:])


def _listed(array: FloatArray) -> tuple[float, ...]:
    return tuple(array.tolist())
