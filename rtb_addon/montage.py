"""Montage: many spectral images, one picture."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from .colorimetry import srgb8, tone_mapped, xyz
from .errors import RecipeError
from .files import replacing
from .recipe.options import MontageOptions
from .spectra import FloatArray
from .spectral_image import SpectralImage


def make_montage(
    images: Iterable[SpectralImage | Path | FloatArray | None], options: MontageOptions | None = None
) -> np.ndarray:
    """
    Return one picture of many spectral images, as 8-bit sRGB.

    Parameters
    ----------
    images : cubes, files of cubes, which are read one after the other, or what tristimulus() made of
        them; None leaves a cell black
    options : grid, tone map and scale; RenderToolbox3's grid if None

    Returns
    -------
    (height, width, 3) uint8 array

    Notes
    -----
    All cells share one tone map and one scale, so that brighter renderings look brighter. The size of a
    cell is that of the first image; a larger one is cropped. As in RenderToolbox3 the mean luminance of the
    tone map counts empty cells.
    """
    options = options or MontageOptions()
    cells = [None if image is None else tristimulus(image) for image in images]
    return srgb8(tone_mapped(arranged(cells, options), options.tone_map), options.scale)


def grid(count: int, options: MontageOptions) -> tuple[int, int]:
    """Return how many rows and columns a number of cells is arranged in."""
    if options.columns is None:
        rows = math.isqrt(count)
        return rows, math.ceil(count / rows)
    return math.ceil(count / options.columns), options.columns


def arranged(cells: Sequence[FloatArray | None], options: MontageOptions) -> FloatArray:
    """Return (height, width, channels) pictures side by side in the grid; cells without one are 0."""
    first = next((cell for cell in cells if cell is not None), None)
    if first is None:
        raise RecipeError("no renderings to show, render some conditions first")
    height, width, channels = first.shape
    rows, columns = grid(len(cells), options)
    picture = np.zeros((rows * height, columns * width, channels), first.dtype)
    for number, cell in enumerate(cells):
        if cell is not None:
            row, column = place(number, rows, columns, options.fill)
            target = picture[row * height : (row + 1) * height, column * width : (column + 1) * width]
            target[:] = _cropped(cell, height, width, number)
    return picture


def write_png(path: Path, picture: np.ndarray) -> None:
    """Write a (height, width, 3) uint8 picture, whole or not at all."""
    from PIL import Image

    with replacing(path) as temporary:
        Image.fromarray(picture).save(temporary, format="PNG", compress_level=1)  # noise hardly compresses


def tristimulus(image: SpectralImage | Path | FloatArray) -> FloatArray:
    """Return X, Y, Z in single precision, (height, width, 3): a tenth of the cube, which can go."""
    if isinstance(image, np.ndarray):
        return image
    cube = SpectralImage.load(image) if isinstance(image, Path) else image
    return xyz(cube).astype(np.float32)


def place(number: int, rows: int, columns: int, fill: str) -> tuple[int, int]:
    """Return the row and the column of a cell."""
    if fill == "rows":
        return divmod(number, columns)
    column, row = divmod(number, rows)
    return row, column


def _cropped(cell: FloatArray, height: int, width: int, number: int) -> FloatArray:
    if cell.shape[0] < height or cell.shape[1] < width:
        size = f"{cell.shape[1]} x {cell.shape[0]}"
        message = f"image {number + 1} is {size} pixels, a montage needs all at least {width} x {height}"
        raise RecipeError(f"{message} like the first")
    return cell[:height, :width]
