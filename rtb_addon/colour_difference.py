"""How different two colours look, after CIE 2000."""

from __future__ import annotations

import numpy as np

from .spectra import FloatArray

D65 = (0.3127, 0.3290)  # xy of what displays show as white
_LINE = 6 / 29  # where CIELAB's cube root becomes a straight line


def white(luminance: float, xy: tuple[float, float] = D65) -> FloatArray:
    """Return X, Y, Z of a white, (3,), of a luminance [cd m-2]."""
    x, y = xy
    return luminance * np.array([x / y, 1, (1 - x - y) / y])


def lab(tristimulus: FloatArray, white_point: FloatArray) -> FloatArray:
    """
    Return CIELAB of X, Y, Z in the last axis.

    Parameters
    ----------
    white_point : X, Y, Z of what has L* 100, (3,)
    """
    share = tristimulus / white_point
    root = np.where(share > _LINE**3, np.cbrt(share), share / (3 * _LINE**2) + 4 / 29)
    x, y, z = np.moveaxis(root, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def delta_e(first: FloatArray, second: FloatArray) -> FloatArray:
    """
    Return the CIEDE2000 difference of two colours in CIELAB (last axis).

    Notes
    -----
    The formula of CIE 142-2001 for its reference conditions, in the symbols of Sharma, Wu and Dalal 2005.
    """
    (light1, chroma1, hue1), (light2, chroma2, hue2) = _with_equal_greys(first, second)
    chroma = (chroma1 + chroma2) / 2
    light_step, chroma_step, turn = light2 - light1, chroma2 - chroma1, _turn(hue2 - hue1)
    hue_step = 2 * np.sqrt(chroma1 * chroma2) * np.sin(turn / 2)
    coloured = chroma1 * chroma2 > 0
    hue = np.where(coloured, hue1 + turn / 2, hue1 + hue2) % (2 * np.pi)
    lights = ((light1 + light2) / 2 - 50) ** 2
    wide_light = 1 + 0.015 * lights / np.sqrt(20 + lights)
    wide_chroma, wide_hue = 1 + 0.045 * chroma, 1 + 0.015 * chroma * _hues(hue)
    blue = 60 * np.exp(-(((np.degrees(hue) - 275) / 25) ** 2))
    rotation = -np.sin(np.radians(blue)) * 2 * _seventh(chroma)
    light_term, chroma_term, hue_term = (
        light_step / wide_light,
        chroma_step / wide_chroma,
        hue_step / wide_hue,
    )
    return np.sqrt(light_term**2 + chroma_term**2 + hue_term**2 + rotation * chroma_term * hue_term)


def _with_equal_greys(first: FloatArray, second: FloatArray) -> list[tuple]:
    """Return lightness, chroma and hue [radians] of both, a* stretched where there is little colour."""
    mean = (np.hypot(first[..., 1], first[..., 2]) + np.hypot(second[..., 1], second[..., 2])) / 2
    stretch = 1 + 0.5 * (1 - _seventh(mean))
    polar = []
    for colour in (first, second):
        light, a, b = np.moveaxis(np.asarray(colour, float), -1, 0)
        polar.append((light, np.hypot(a * stretch, b), np.arctan2(b, a * stretch) % (2 * np.pi)))
    return polar


def _seventh(chroma: FloatArray) -> FloatArray:
    """Return how much colour there is, from 0 to 1, in CIEDE2000's measure."""
    return np.sqrt(chroma**7 / (chroma**7 + 25.0**7))


def _turn(angle: FloatArray) -> FloatArray:
    """Return an angle between two hues [radians] the short way round."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def _hues(hue: FloatArray) -> FloatArray:
    """Return how hues [radians] differ in how wide a step of them looks."""
    times, shift, weight = np.array([(1, -30, -0.17), (2, 0, 0.24), (3, 6, 0.32), (4, -63, -0.20)]).T
    return 1 + np.cos(np.multiply.outer(hue, times) + np.radians(shift)) @ weight
