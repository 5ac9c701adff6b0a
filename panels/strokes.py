"""Lines, boxes and words over an Image Editor, drawn with gpu."""

from __future__ import annotations

from collections.abc import Sequence

import blf
import bpy
import gpu
from gpu_extras.batch import batch_for_shader

Colour = Sequence[float]  # red, green, blue and alpha
FONT = 0
SIZE = 11  # of letters [pixels at scale 1]


def scale() -> float:
    """Return how many pixels of the screen are one of the interface."""
    return bpy.context.preferences.system.ui_scale or 1.0


def fill(left: float, bottom: float, right: float, top: float, colour: Colour) -> None:
    """Fill a box."""
    corners = ((left, bottom), (right, bottom), (right, top), (left, top))
    _draw("UNIFORM_COLOR", "TRIS", corners, colour, indices=((0, 1, 2), (0, 2, 3)))


def line(points: Sequence[tuple[float, float]], colour: Colour, width: float = 1.0) -> None:
    """Draw straight lines from point to point."""
    if len(points) > 1:
        _draw("POLYLINE_UNIFORM_COLOR", "LINE_STRIP", points, colour, width=width * scale())


def frame(left: float, bottom: float, right: float, top: float, colour: Colour, width: float = 1.0) -> None:
    """Draw the edge of a box."""
    line(((left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)), colour, width)


def words(text: str, x: float, y: float, colour: Colour, align: float = 0.0, size: float = SIZE) -> float:
    """
    Write a line of text and return its width [pixels].

    Parameters
    ----------
    x, y : of its base line
    align : what part of its width lies left of x
    """
    blf.size(FONT, size * scale())
    width = blf.dimensions(FONT, text)[0]
    blf.color(FONT, *colour)
    blf.position(FONT, x - align * width, y, 0)
    blf.draw(FONT, text)
    return width


def _draw(
    name: str, kind: str, points: Sequence, colour: Colour, indices=None, width: float | None = None
) -> None:
    shader = gpu.shader.from_builtin(name)
    batch = batch_for_shader(shader, kind, {"pos": [(*point, 0.0) for point in points]}, indices=indices)
    gpu.state.blend_set("ALPHA")
    shader.uniform_float("color", colour)
    if width is not None:
        shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
        shader.uniform_float("lineWidth", width)
    batch.draw(shader)
    gpu.state.blend_set("NONE")
