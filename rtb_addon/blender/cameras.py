"""Blender's cameras as Collada ones: what part of the world ends up in the picture."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..errors import RecipeError

_NEAREST = 1e-5  # that Blender focuses at [scene units]


@dataclass(frozen=True)
class View:
    """
    What a camera sees, across the picture.

    Parameters
    ----------
    width : of the picture, one unit ahead (perspective) or across the view (orthographic) [scene units]
    aspect : the picture's width by its height
    pixel_aspect : a pixel's width by its height
    shift : right and up, as fractions of the picture's longer side
    clip : near and far [scene units]
    lens : radius of the lens and the distance that is sharp [scene units]; None where all is sharp
    """

    projection: Literal["perspective", "orthographic"]
    width: float
    aspect: float
    pixel_aspect: float
    shift: tuple[float, float]
    clip: tuple[float, float]
    lens: tuple[float, float] | None = None

    @property
    def xfov(self) -> float:
        """Angle across the width [degrees]."""
        return math.degrees(2 * math.atan(self.width / 2))

    @property
    def yfov(self) -> float:
        """Angle across the height [degrees]."""
        return math.degrees(2 * math.atan(self.width / self.aspect / 2))


def view_of(camera, render, size: tuple[int, int], name: str) -> View:
    """
    Return what a camera sees in a picture of a size [pixels].

    The sensor is fitted to the width or to the height; automatically, to the longer side, and then it
    is the sensor's width that counts for both. Shift is counted in the side that the sensor fits.
    """
    if camera.type not in ("PERSP", "ORTHO"):
        raise RecipeError(f"the camera {name} is panoramic, make it perspective or orthographic")
    aspect = size[0] * render.pixel_aspect_x / (size[1] * render.pixel_aspect_y)
    across = aspect >= 1 if camera.sensor_fit == "AUTO" else camera.sensor_fit == "HORIZONTAL"
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    side = camera.ortho_scale if camera.type == "ORTHO" else sensor / camera.lens
    width = side if across else side * aspect
    shift = side / max(width, width / aspect)
    return View(
        "orthographic" if camera.type == "ORTHO" else "perspective",
        width,
        aspect,
        render.pixel_aspect_x / render.pixel_aspect_y,
        (camera.shift_x * shift, camera.shift_y * shift),
        (camera.clip_start, camera.clip_end),
    )


def lens_of(camera, to_world) -> tuple[float, float] | None:
    """
    Return the radius of a camera's lens and the distance that is sharp, or None [scene units].

    As Cycles has it: the focal length by twice the f-number, millimetres being thousandths of a unit, and the
    distance of the focus object along the view.

    Parameters
    ----------
    to_world : (4, 4) array, of the camera
    """
    if not camera.dof.use_dof or camera.type != "PERSP":
        return None
    radius = camera.lens * 1e-3 / (2 * camera.dof.aperture_fstop)
    focus = camera.dof.focus_object
    if focus is None:
        return radius, max(camera.dof.focus_distance, _NEAREST)
    ahead = np.array(to_world[:3, 2]) / np.linalg.norm(to_world[:3, 2])
    distance = abs(float(ahead @ (np.array(focus.matrix_world.translation) - to_world[:3, 3])))
    return radius, max(distance, _NEAREST)


def not_round(camera) -> Iterator[str]:
    """Yield what of a camera's depth of field no renderer here has, a clause each."""
    dof = camera.dof
    if not dof.use_dof:
        return
    if camera.type == "ORTHO":
        yield "is sharp everywhere, for its view is parallel"
        return
    if dof.aperture_blades > 2 or dof.aperture_ratio != 1.0:
        yield "has a round aperture, without its blades and ratio"
    if dof.focus_object is not None and dof.focus_subtarget:
        yield "is focused on the whole armature, not on its bone"
