"""A Collada camera as renderers see it."""

from __future__ import annotations

from typing import Literal

import numpy as np

from ...spectra import FloatArray
from ..paths import Element, local_name
from ..render_scene import Camera, Film
from .sources import PROFILE, child, extra_child, number

Window = tuple[float, float, float, float]
_CLIP = (1e-3, 1e5)


def read_camera(
    camera: Element, name: str, to_world: FloatArray, unit: float, film: Film, mirrored: bool
) -> Camera:
    """
    Return a camera that takes pictures of a film's size.

    ``xfov`` is the full angle over the picture's width and ``xmag`` half that width, whatever
    ``aspect_ratio`` says: pixels are square, unless ``yfov`` or ``ymag`` stands beside it for the height.
    ``shiftx`` and ``shifty`` of Blender's own part are fractions of the picture's larger side;
    ``lens_radius`` and ``focus_distance`` of ours are lengths of a thin lens.

    Parameters
    ----------
    to_world : (4, 4) array [m], with any scale
    unit : of the document's lengths [m]
    mirrored : whether the camera's X axis points left, as RenderToolbox3's importers had it
    """
    optics = child(camera, "optics", "technique_common")
    kinds = (
        []
        if optics is None
        else [each for each in optics if local_name(each) in ("perspective", "orthographic")]
    )
    if optics is None or not kinds:
        raise ValueError(f"the camera {name} is neither perspective nor orthographic")
    lens = kinds[0]
    flip = np.diag([-1.0 if mirrored else 1.0, 1.0, 1.0, 1.0])
    window = _shifted(_window(lens, name, unit, film.height / film.width), camera)
    projection: Literal["perspective", "orthographic"] = (
        "perspective" if local_name(lens) == "perspective" else "orthographic"
    )
    thin = _thin_lens(camera, name, unit)
    return Camera(name, projection, rigid(to_world @ flip), window, _clip(lens, unit), *thin)


def rigid(to_world: FloatArray) -> FloatArray:
    """Return a matrix without its scale and shear: Z keeps its direction, and a mirroring stays one."""
    back = _direction(to_world[:3, 2])
    up = _direction(to_world[:3, 1] - back * (back @ to_world[:3, 1]))
    right = np.cross(up, back) * (1.0 if np.linalg.det(to_world[:3, :3]) > 0 else -1.0)
    matrix = np.eye(4)
    matrix[:3] = np.stack([right, up, back, to_world[:3, 3]], axis=1)
    return matrix


def _direction(vector: FloatArray) -> FloatArray:
    length = np.linalg.norm(vector)
    if not length > 0:
        raise ValueError("a scale of 0 leaves no direction to look in")
    return vector / length


def _window(lens: Element, name: str, unit: float, aspect: float) -> tuple[float, float]:
    """Return half the picture's width and height; aspect is height over width."""
    perspective = local_name(lens) == "perspective"
    width, height = (
        _half(lens, each, unit) for each in (("xfov", "yfov") if perspective else ("xmag", "ymag"))
    )
    if width is None and height is None:
        raise ValueError(f"the camera {name} has no {'xfov' if perspective else 'xmag'}")
    if width is None:
        width = (height or 0.0) / aspect
    return width, width * aspect if height is None else height


def _half(lens: Element, name: str, unit: float) -> float | None:
    element = child(lens, name)
    if element is None:
        return None
    value = number(element, 0.0)
    if name.endswith("mag"):
        half, right = abs(value) * unit, value != 0
    else:
        half, right = float(np.tan(np.radians(value) / 2)), 0 < value < 180
    if not right:
        raise ValueError(
            f"{name} is {value:g}, want {'a length' if name.endswith('mag') else '0 to 180 degrees'}"
        )
    return half


def _shifted(halves: tuple[float, float], camera: Element) -> Window:
    side = 2 * max(halves)
    x, y = (side * number(extra_child(camera, name), 0.0) for name in ("shiftx", "shifty"))
    return x - halves[0], x + halves[0], y - halves[1], y + halves[1]


def _thin_lens(camera: Element, name: str, unit: float) -> tuple[float, float]:
    """Return a lens's radius and the distance that is sharp [m]."""
    radius, distance = (
        number(extra_child(camera, word, PROFILE), default / unit) * unit
        for word, default in (("lens_radius", 0.0), ("focus_distance", 1.0))
    )
    if radius < 0 or distance <= 0:
        raise ValueError(
            f"the camera {name} has a lens of radius {radius:g} m focused at {distance:g} m, want at least 0"
            " and more than 0"
        )
    return radius, distance


def _clip(lens: Element, unit: float) -> tuple[float, float]:
    near, far = (
        number(child(lens, name), default / unit) * unit
        for name, default in zip(("znear", "zfar"), _CLIP, strict=True)
    )
    return (near, far) if 0 < near < far else _CLIP
