"""Ways to look at radiance cubes: as they appear, one band, luminance, how far they are from another one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np

from .colorimetry import brightest_scale, encoded, linear_srgb, tone_mapped
from .errors import RecipeError
from .montage import arranged, grid, place, tristimulus
from .recipe.options import MontageOptions
from .spectra import FloatArray
from .spectral_image import UNIT, SpectralImage

Kind = Literal["srgb", "wavelength", "luminance", "difference"]
LUMINANCE_UNIT = "cd m-2"


@dataclass(frozen=True)
class View:
    """
    What a picture shows of cubes.

    Parameters
    ----------
    kind : srgb: as they appear; wavelength: the radiance of one band, in grey; luminance, in false colour;
        difference: root mean square over the bands of the difference to another cube, in false colour
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

    def of(self, cube: SpectralImage, other: SpectralImage | None = None) -> FloatArray:
        """Return what is to be seen of a cube, (height, width, 3 or 1) in single precision."""
        if self.kind == "wavelength":
            nearest = np.abs(cube.bands.centres - self.wavelength).argmin()
            return cube.radiance[:, :, nearest, None]
        if self.kind == "difference":
            return _distance(cube, other)
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


@dataclass(frozen=True)
class Tiles:
    """
    Which condition lies where in a picture.

    Parameters
    ----------
    names : of the conditions, in the order of the montage
    rows, columns, fill : of the grid
    width, height : of a cube [pixels]
    reduced : how many pixels of a cube, across and down, are one of the picture
    """

    names: tuple[str, ...]
    rows: int
    columns: int
    fill: str
    width: int
    height: int
    reduced: int = 1

    @classmethod
    def of(
        cls, names: Sequence[str], size: tuple[int, int], options: MontageOptions, reduced: int = 1
    ) -> Tiles:
        """Return how a montage of cubes of a size (width, height) is arranged."""
        return cls(tuple(names), *grid(len(names), options), options.fill, *size, reduced)

    @classmethod
    def from_words(cls, words: Mapping[str, Any]) -> Tiles:
        """Return what to_words() wrote."""
        return cls(**{**words, "names": tuple(words["names"])})

    def to_words(self) -> dict[str, Any]:
        """Return them as JSON can write them."""
        return asdict(self)

    @property
    def tile(self) -> tuple[int, int]:
        """Width and height of a condition in the picture [pixels of the picture]."""
        return self.width // self.reduced, self.height // self.reduced

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture [pixels of the picture]."""
        width, height = self.tile
        return self.columns * width, self.rows * height

    def corner(self, name: str) -> tuple[int, int]:
        """Return the left and upper edge of a condition [pixels of the picture]."""
        row, column = place(self.names.index(name), self.rows, self.columns, self.fill)
        width, height = self.tile
        return column * width, row * height

    def at(self, x: float, y: float) -> tuple[str, int, int] | None:
        """Return whose pixel lies at a place [pixels of the picture], with its column and row in the cube."""
        width, height = self.tile
        column, row = int(x // width), int(y // height)
        if not (0 <= column < self.columns and 0 <= row < self.rows):
            return None
        number = row * self.columns + column if self.fill == "rows" else column * self.rows + row
        if number >= len(self.names):
            return None
        across, down = x - column * width, y - row * height
        return self.names[number], int(across * self.reduced), int(down * self.reduced)

    def within(self, name: str, x: float, y: float) -> tuple[int, int]:
        """Return the column and the row of the pixel of a condition that is nearest to a place."""
        left, top = self.corner(name)
        across, down = int((x - left) * self.reduced), int((y - top) * self.reduced)
        return min(max(across, 0), self.width - 1), min(max(down, 0), self.height - 1)


def reduced(seen: FloatArray, by: int) -> FloatArray:
    """Return a (height, width, channels) picture with the means of so many pixels across and down."""
    if by == 1:
        return seen
    height, width = seen.shape[0] // by * by, seen.shape[1] // by * by
    blocks = seen[:height, :width].reshape(height // by, by, width // by, by, -1)
    return blocks.mean(axis=(1, 3), dtype=np.float32)


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


def single(options: MontageOptions) -> MontageOptions:
    """Return how one cube alone is shown: by the montage's tone map and scale."""
    return replace(options, columns=1)


def _distance(cube: SpectralImage, other: SpectralImage | None) -> FloatArray:
    if other is None:
        raise RecipeError("a difference needs another condition, choose one that is rendered")
    if cube.radiance.shape != other.radiance.shape or not np.allclose(
        cube.bands.centres, other.bands.centres
    ):
        raise RecipeError("the two conditions differ in size or in bands, they cannot be compared")
    difference = cube.radiance - other.radiance
    return np.sqrt(np.einsum("hwb,hwb->hw", difference, difference) / difference.shape[2])[..., None]
