"""Spectra to XYZ to sRGB, as RenderToolbox3 computes it."""

from __future__ import annotations

import numpy as np

from .errors import RenderingError
from .observers import matching_functions
from .spectra import FloatArray
from .spectral_image import SpectralImage

# Lumens per watt at 555 nm: Y of a radiance is then its luminance.
EFFICACY = 683.0

# RenderToolbox3's four decimals, and its limit between the line and the power of the sRGB curve.
_LINEAR_SRGB = np.array([[3.2410, -1.5374, -0.4986], [-0.9692, 1.8760, 0.0416], [0.0556, -0.2040, 1.0570]])
_STRAIGHT_BELOW = 0.00304
_PIECE = 1 << 16


def xyz(image: SpectralImage) -> FloatArray:
    """
    Return the CIE 1931 tristimulus values of every pixel.

    Returns
    -------
    (height, width, 3) array : X, Y, Z; Y is luminance [cd m-2]
    """
    if not np.isfinite(image.radiance).all():
        raise RenderingError("the image holds radiances that are no finite numbers")
    per_band = EFFICACY * matching_functions(image.bands) * image.bands.widths[:, None]
    return image.radiance @ per_band


def linear_srgb(tristimulus: FloatArray) -> FloatArray:
    """Return linear sRGB, neither clipped nor normalised, of X, Y, Z in the last axis."""
    return tristimulus @ _LINEAR_SRGB.T.astype(np.result_type(tristimulus, np.float32))


def tone_mapped(tristimulus: FloatArray, factor: float) -> FloatArray:
    """
    Return X, Y, Z with no pixel's Y above factor times the mean Y of the picture; chromaticities stay.

    Parameters
    ----------
    tristimulus : (height, width, 3) array
    factor : 0 leaves the picture as it is
    """
    if factor <= 0:
        return tristimulus
    return luminance_limited(tristimulus, factor * float(tristimulus[..., 1].mean(dtype=float)))


def luminance_limited(tristimulus: FloatArray, limit: float) -> FloatArray:
    """Return X, Y, Z with no pixel's Y above a limit [cd m-2]; chromaticities stay."""
    luminance = tristimulus[..., 1]
    too_bright = luminance > limit
    return tristimulus * np.where(too_bright, limit / np.where(too_bright, luminance, 1), 1)[..., None]


def srgb8(tristimulus: FloatArray, scale: float | None = None) -> np.ndarray:
    """
    Return 8-bit sRGB of X, Y, Z in the last axis.

    Parameters
    ----------
    scale : what linear sRGB is multiplied by; None: the brightest channel of the picture becomes 1, and a
        picture that is black everywhere stays black
    """
    linear = linear_srgb(tristimulus)
    return encoded(linear, brightest_scale(linear) if scale is None else scale)


def brightest_scale(linear: FloatArray) -> float:
    """Return what makes the brightest channel of linear sRGB 1; 1 for a picture without light."""
    brightest = float(linear.max(initial=0))
    return 1 / brightest if brightest > 0 else 1.0


def encoded(linear: FloatArray, scale: float = 1.0) -> np.ndarray:
    """
    Return 8-bit sRGB of linear sRGB times a scale, clipped to 0 to 1.

    Notes
    -----
    Piece by piece, each small enough for the processor's cache: a montage of many cubes takes a third of
    the time. Single precision is a thousand times finer than the 256 codes.
    """
    codes = np.empty(linear.shape, np.uint8)
    flat, values = codes.reshape(-1), linear.reshape(-1)
    for start in range(0, len(flat), _PIECE):
        piece = slice(start, start + _PIECE)
        flat[piece] = _encoded(np.clip(values[piece] * scale, 0, 1).astype(np.float32))
    return codes


def _encoded(clipped: FloatArray) -> FloatArray:
    curve = np.where(clipped < _STRAIGHT_BELOW, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    return np.floor(255 * curve + 0.5)
