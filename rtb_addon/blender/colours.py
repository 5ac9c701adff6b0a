"""Colours from Blender's working space, which from Blender 5 on may be another one, to linear Rec.709."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import ArrayLike

from ..spectra import FloatArray

_REC709 = "Linear Rec.709"
_D65 = (0.3127, 0.3290)
# Red, green, blue and white of each working space that Blender offers: CIE 1931 x, y.
SPACES = {
    _REC709: ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06), _D65),
    "Linear Rec.2020": ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046), _D65),
    "ACEScg": ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044), (0.32168, 0.33767)),
}
# Bradford's cone responses, by which one white is adapted to another.
_BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


def working_space() -> str:
    """Return the name of the space that Blender's colours are in; before Blender 5 there was one."""
    space = getattr(bpy.data, "colorspace", None)
    return _REC709 if space is None else space.working_space


def linear_rec709(colour: Sequence[float]) -> tuple[float, float, float]:
    """Return a colour of Blender's in linear Rec.709; what lies outside it becomes 0."""
    rgb = np.asarray(colour[:3], float)
    space = working_space()
    if space != _REC709:
        rgb = to_rec709(space) @ rgb
    red, green, blue = np.maximum(rgb, 0.0).tolist()
    return red, green, blue


def in_working_space(encoded: ArrayLike) -> list[float]:
    """Return 8-bit sRGB as a colour of Blender's working space."""
    stored = np.asarray(encoded, float) / 255
    linear = np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)
    space = working_space()
    return (linear if space == _REC709 else np.linalg.solve(to_rec709(space), linear)).tolist()


def to_rec709(space: str) -> FloatArray:
    """(3, 3) array that brings colours of a working space to linear Rec.709"""
    white, wanted = (_xyz(*SPACES[name][3]) for name in (space, _REC709))
    gains = (_BRADFORD @ wanted) / (_BRADFORD @ white)
    adapted = np.linalg.solve(_BRADFORD, gains[:, None] * _BRADFORD)
    return np.linalg.solve(_to_xyz(_REC709), adapted @ _to_xyz(space))


def xyz_to_working_space() -> FloatArray:
    """(3, 3) array that brings X, Y, Z to Blender's working space, whose red, green and blue of 1 have Y 1"""
    return np.linalg.solve(to_rec709(working_space()), np.linalg.inv(_to_xyz(_REC709)))


def _to_xyz(space: str) -> FloatArray:
    *primaries, white = SPACES[space]
    columns = np.column_stack([_xyz(*each) for each in primaries])
    return columns * np.linalg.solve(columns, _xyz(*white))


def _xyz(x: float, y: float) -> FloatArray:
    return np.array([x / y, 1.0, (1 - x - y) / y])
