"""Ways to look at radiance cubes: as they appear, one band, luminance, how far from another, how certain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from .colorimetry import brightest_scale, encoded, linear_srgb, tone_mapped
from .errors import RecipeError
from .montage import arranged, tristimulus
from .recipe.options import MontageOptions
from .spectra import FloatArray
from .spectral_image import UNIT, SpectralImage

Kind = Literal["srgb", "wavelength", "luminance", "difference", "error"]
LUMINANCE_UNIT = "cd m-2"


@dataclass(frozen=True)
class View:
    """
    What a picture shows of cubes.

    Parameters
    ----------
    kind : srgb: as they appear; wavelength: the radiance of one band, in grey; luminance, in false colour;
        difference: root mean square over the bands of the difference to another cube, in false colour; error:
        the same of the standard errors
    wavelength : that the band is nearest to [nm]
    full : what is shown white or in the last colour, [cd m-2] or, of a band and of differences,
        [W sr-1 m-2 nm-1]; None: what is brightest in the picture
    """

    kind: Kind = "srgb"
    wavelength: float = 550.0
    full: float | None = None

    @property
    def unit(self) -> str:
        """Of full."""
        return LUMINANCE_UNIT if self.kind in ("srgb", "luminance") else UNIT

    def of(
        self, cube: SpectralImage, other: SpectralImage | None = None, error: FloatArray | None = None
    ) -> FloatArray:
        """
        Return what is to be seen of a cube, (height, width, 3 or 1) in single precision.

        Parameters
        ----------
        other : the cube that a difference is to
        error : standard errors of the cube, (height, width, bands) [W sr-1 m-2 nm-1]
        """
        if self.kind == "wavelength":
            nearest = np.abs(cube.bands.centres - self.wavelength).argmin()
            return cube.radiance[:, :, nearest, None]
        if self.kind == "difference":
            return _distance(cube, other)
        if self.kind == "error":
            assert error is not None
            return _mean_square_root(error)
        seen = tristimulus(cube)
        return seen if self.kind == "srgb" else seen[:, :, 1, None]

    def drawn(self, cells: Sequence[FloatArray | None], options: MontageOptions) -> tuple[np.ndarray, float]:
        """
        Return one 8-bit sRGB picture of what is to be seen of some cubes, and what is brightest in it [unit].

        Parameters
        ----------
        cells : what of() returned, None where there is no cube
        """
        picture = arranged(cells, options)
        if self.kind == "srgb":
            linear = linear_srgb(tone_mapped(picture, options.tone_map))
            scale = options.scale or brightest_scale(linear) if self.full is None else 1 / self.full
            return encoded(linear * scale), 1 / scale
        full = self.full or float(picture.max()) or 1.0
        share = np.clip(picture[..., 0] / full, 0, 1)
        if self.kind == "wavelength":
            return np.repeat(encoded(share)[..., None], 3, axis=2), full
        return false_colours()[np.rint(255 * share).astype(np.uint8)], full


def reduced(seen: FloatArray, by: int) -> FloatArray:
    """Return a (height, width, channels) picture with the means of so many pixels across and down."""
    if by == 1:
        return seen
    height, width = seen.shape[0] // by * by, seen.shape[1] // by * by
    blocks = seen[:height, :width].reshape(height // by, by, width // by, by, -1)
    return blocks.mean(axis=(1, 3), dtype=np.float32)


def colours_of(kind: Kind) -> np.ndarray:
    """Return the colours in which a view shows shares of its scale from 0 to 1, 8-bit sRGB, (256, 3)."""
    if kind == "wavelength":
        return np.repeat(encoded(np.linspace(0, 1, 256))[:, None], 3, axis=1)
    return false_colours()


def false_colours() -> np.ndarray:
    """
    Return colours from black to white that grow lighter evenly, 8-bit sRGB, (256, 3).

    Notes
    -----
    Green's cubehelix (2011) with half a turn less: dark blue, green, orange, white.
    """
    share = np.linspace(0, 1, 256)
    angle = 2 * np.pi * (0.5 / 3 + 1 - 1.2 * share)
    swing = 1.2 * share * (1 - share) / 2
    turns = np.array([[-0.14861, 1.78277], [-0.29227, -0.90649], [1.97294, 0.0]])
    colours = share + swing * (turns @ np.stack([np.cos(angle), np.sin(angle)]))
    return np.rint(255 * np.clip(colours.T, 0, 1)).astype(np.uint8)


def _distance(cube: SpectralImage, other: SpectralImage | None) -> FloatArray:
    if other is None:
        raise RecipeError("a difference needs another condition, choose one that is rendered")
    if cube.radiance.shape != other.radiance.shape or not np.allclose(
        cube.bands.centres, other.bands.centres
    ):
        raise RecipeError("the two conditions differ in size or in bands, they cannot be compared")
    return _mean_square_root(cube.radiance - other.radiance)


def _mean_square_root(values: FloatArray) -> FloatArray:
    """Return the root mean square over the bands, (height, width, 1)."""
    return np.sqrt(np.einsum("hwb,hwb->hw", values, values) / values.shape[2])[..., None]
