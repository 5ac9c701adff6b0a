"""Blender's cameras as Collada ones: what part of the world ends up in the picture."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from ..errors import RecipeError


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
    """

    projection: Literal["perspective", "orthographic"]
    width: float
    aspect: float
    pixel_aspect: float
    shift: tuple[float, float]
    clip: tuple[float, float]

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
