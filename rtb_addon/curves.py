"""A spectrum drawn as a picture for a panel: axes, the curve, and a swatch of its colour below."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from .digits import WIDTH, letters
from .spectra import FloatArray, Spectrum

RANGE = (380.0, 780.0)  # [nm]
TICKS = (400, 500, 600, 700)  # [nm]
_SWATCH = 0.16  # of the picture's height
_NICE = (1.0, 2.0, 5.0, 10.0)


@dataclass(frozen=True)
class Plot:
    """
    Where the axes lie in a picture.

    Parameters
    ----------
    left, right, bottom, top : edges [pixels], counted from the lower left corner
    highest : what the upper edge stands for [the spectrum's unit]
    """

    left: int
    right: int
    bottom: int
    top: int
    highest: float

    def across(self, wavelength: float) -> int:
        """Return the column of a wavelength [nm]."""
        share = (wavelength - RANGE[0]) / (RANGE[1] - RANGE[0])
        return self.left + round(share * (self.right - self.left - 1))

    def heights(self, spectrum: Spectrum, columns: FloatArray) -> FloatArray:
        """Return the row of the curve at some columns, kept within the axes."""
        share = (columns - self.left) / max(self.right - self.left - 1, 1)
        values = spectrum.at(RANGE[0] + share * (RANGE[1] - RANGE[0])) / self.highest
        return self.bottom + np.clip(values, 0, 1) * (self.top - self.bottom - 1)


def curve_picture(
    spectrum: Spectrum, size: int, colour: ArrayLike | None, ink: ArrayLike, magnified: int = 1
) -> np.ndarray:
    """
    Return a spectrum's curve from 380 to 780 nm, clear where nothing is drawn.

    Parameters
    ----------
    size : of the square picture's side [pixels]
    colour : of the swatch, 8-bit sRGB, (3,); None for no swatch
    ink : of lines and letters, 8-bit sRGB, (3,)
    magnified : how many pixels a pixel of a letter takes

    Returns
    -------
    (size, size, 4) float32 array : sRGB and alpha, 0 to 1, from the lowest row up
    """
    picture = np.zeros((size, size, 4), np.float32)
    picture[..., :3] = np.asarray(ink, np.float32) / 255
    seen = (spectrum.wavelengths > RANGE[0]) & (spectrum.wavelengths < RANGE[1])
    highest = nice_above(float(np.concatenate([spectrum.at(RANGE), spectrum.values[seen]]).max()))
    swatch = 0 if colour is None else max(round(size * _SWATCH), 1)
    plot = _plot(size, highest, magnified, swatch)
    _draw_axes(picture, plot, magnified)
    _draw_curve(picture, plot, spectrum)
    if colour is not None:
        picture[:swatch, plot.left : plot.right, :3] = np.asarray(colour, np.float32) / 255
        picture[:swatch, plot.left : plot.right, 3] = 1
    return picture


def curve_icon(spectrum: Spectrum, size: int, colour: ArrayLike) -> np.ndarray:
    """
    Return a spectrum as a small tile of its colour, the curve across it in black or white.

    Parameters
    ----------
    size : of the square tile's side [pixels]
    colour : 8-bit sRGB, (3,)

    Returns
    -------
    (size, size, 4) float32 array : sRGB and alpha, 0 to 1, from the lowest row up
    """
    tile = np.ones((size, size, 4), np.float32)
    tile[..., :3] = np.asarray(colour, np.float32) / 255
    values = spectrum.at(np.linspace(*RANGE, size))
    heights = 2 + (size - 5) * values / max(float(values.max()), np.finfo(float).tiny)
    rows = np.arange(size)[:, None]
    low, high = np.minimum(heights, np.roll(heights, 1)), np.maximum(heights, np.roll(heights, 1))
    low[0] = high[0] = heights[0]
    line = np.clip(1.2 - np.maximum(np.maximum(low - rows, rows - high), 0), 0, 1)[..., None]
    ink = 0.0 if tile[0, 0, :3] @ (0.3, 0.6, 0.1) > 0.5 else 1.0
    tile[..., :3] += line * (ink - tile[..., :3])
    return tile


def nice_above(value: float) -> float:
    """Return 1, 2 or 5 times a power of ten that is not below a value; 1 for nothing."""
    if not value > 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(next(nice * power for nice in _NICE if value <= nice * power * (1 + 1e-9)))


def _plot(size: int, highest: float, magnified: int, swatch: int) -> Plot:
    """Leave room for the swatch and the wavelengths below, and for the values at the left."""
    widest = max(len(text) for text in (f"{highest:g}", "0"))
    left = (widest * WIDTH + 2) * magnified
    bottom = swatch + 15 * magnified
    return Plot(left, size, bottom, size - 4 * magnified, highest)


def _draw_axes(picture: np.ndarray, plot: Plot, magnified: int) -> None:
    """Draw a frame, a line for each hundred nanometres, and what the edges stand for."""
    alpha = picture[..., 3]
    for wavelength in TICKS:
        column = plot.across(wavelength)
        alpha[plot.bottom : plot.top, column] = 0.18
        text = letters(str(wavelength), magnified)
        _write(alpha, text, column - text.shape[1] // 2, plot.bottom - 11 * magnified)
    alpha[(plot.bottom + plot.top) // 2, plot.left : plot.right] = 0.18
    alpha[plot.bottom : plot.top, [plot.left, plot.right - 1]] = 0.4
    alpha[[plot.bottom, plot.top - 1], plot.left : plot.right] = 0.4
    for text, row in ((f"{plot.highest:g}", plot.top - 5 * magnified), ("0", plot.bottom - 1)):
        shape = letters(text, magnified)
        _write(alpha, shape, plot.left - shape.shape[1] - 2 * magnified, row)


def _draw_curve(picture: np.ndarray, plot: Plot, spectrum: Spectrum) -> None:
    """Draw the curve as thick as two pixels, smooth at its edges, over a faint area."""
    columns = np.arange(plot.left, plot.right)
    near = np.stack([plot.heights(spectrum, columns + step) for step in (-0.5, 0.0, 0.5)])
    low, high = near.min(axis=0), near.max(axis=0)
    # A lamp's line may lie between two columns; its peak counts for the one that is next.
    across = (spectrum.wavelengths - RANGE[0]) / (RANGE[1] - RANGE[0]) * (plot.right - plot.left - 1)
    seen = (across >= 0) & (across <= plot.right - plot.left - 1)
    nearest, heights = np.rint(across[seen]).astype(int), plot.heights(spectrum, plot.left + across[seen])
    np.minimum.at(low, nearest, heights)
    np.maximum.at(high, nearest, heights)
    rows = np.arange(plot.bottom, plot.top)[:, None]
    outside = np.maximum(np.maximum(low - rows, rows - high), 0)
    line = np.clip(1.5 - outside, 0, 1)
    below = np.where(rows < near[1], 0.12, 0.0)
    place = picture[plot.bottom : plot.top, plot.left : plot.right, 3]
    np.maximum(place, np.maximum(line, place + below), out=place)


def _write(alpha: np.ndarray, shape: np.ndarray, column: int, row: int) -> None:
    """Set letters with their lower left corner at a place, as far as they lie in the picture."""
    column = min(max(column, 0), alpha.shape[1] - shape.shape[1])
    row = min(max(row, 0), alpha.shape[0] - shape.shape[0])
    place = alpha[row : row + shape.shape[0], column : column + shape.shape[1]]
    np.maximum(place, 0.85 * shape, out=place)
