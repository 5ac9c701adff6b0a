"""The transforms of a node: matrices that act on column vectors, the last element acting first."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...spectra import FloatArray
from ..paths import Element, local_name
from .sources import floats


def local_matrix(node: Element) -> FloatArray:
    """Return the (4, 4) array that a node's transforms make together; ValueError for one that makes none."""
    matrix = np.eye(4)
    for each in node:
        name = local_name(each)
        if name in TRANSFORMS:
            count, make = TRANSFORMS[name]
            try:
                matrix = matrix @ make(floats(each, count))
            except ValueError as error:
                raise ValueError(f"{error}, in the node {node.get('id') or node.get('name')}") from error
    return matrix


def translate(offset: FloatArray) -> FloatArray:
    """Return a shift by (3,) numbers."""
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def scale(factors: FloatArray) -> FloatArray:
    """Return a scale by (3,) factors."""
    return np.diag([*factors, 1.0])


def rotate(numbers: FloatArray) -> FloatArray:
    """Return a turn about an axis, three numbers, by an angle [degrees], the fourth (Rodrigues)."""
    x, y, z, angle = map(float, numbers)
    length = math.hypot(x, y, z)
    if length == 0:
        raise ValueError("a rotate needs an axis, not 0 0 0")
    x, y, z = x / length, y / length, z / length
    # Plain numbers: a scene of many objects has tens of thousands of these.
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    rest = 1 - cosine
    return np.array(
        [
            [cosine + x * x * rest, x * y * rest - z * sine, x * z * rest + y * sine, 0],
            [y * x * rest + z * sine, cosine + y * y * rest, y * z * rest - x * sine, 0],
            [z * x * rest - y * sine, z * y * rest + x * sine, cosine + z * z * rest, 0],
            [0, 0, 0, 1],
        ]
    )


def look_at(numbers: FloatArray) -> FloatArray:
    """Return where something stands that looks along its -Z axis from an eye to a point, +Y up."""
    eye, point, up = numbers.reshape(3, 3)
    back = eye - point
    right = np.cross(up, back)
    if not np.linalg.norm(right) > 0:
        raise ValueError("a lookat needs two points and a direction up that is not the way it looks")
    columns = [right, np.cross(back, right), back]
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([each / np.linalg.norm(each) for each in columns], axis=1)
    matrix[:3, 3] = eye
    return matrix


def skew(numbers: FloatArray) -> FloatArray:
    """
    Return a shear, as RenderMan has it.

    Parameters
    ----------
    numbers : an angle [degrees], the axis that it turns, the axis towards which everything is shifted
    """
    turned, shifted = numbers[1:4], numbers[4:7]
    if not (turned.any() and shifted.any()):
        raise ValueError("a skew needs two axes, not 0 0 0")
    along = shifted / np.linalg.norm(shifted)
    across = turned - along * (turned @ along)
    if np.linalg.norm(across) < 1e-9 * np.linalg.norm(turned):
        raise ValueError("the two axes of a skew must not be parallel")
    across /= np.linalg.norm(across)
    before = np.arctan2(turned @ along, turned @ across)
    after = before + np.radians(numbers[0])
    if np.cos(after) < 1e-9:
        raise ValueError(f"a skew by {numbers[0]:g} degrees turns its axis too far, want less")
    matrix = np.eye(4)
    matrix[:3, :3] += (np.tan(after) - np.tan(before)) * np.outer(along, across)
    return matrix


TRANSFORMS: dict[str, tuple[int, Callable[[FloatArray], FloatArray]]] = {
    "matrix": (16, lambda numbers: numbers.reshape(4, 4)),
    "translate": (3, translate),
    "rotate": (4, rotate),
    "scale": (3, scale),
    "lookat": (9, look_at),
    "skew": (7, skew),
}
