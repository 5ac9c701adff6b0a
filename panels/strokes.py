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


def words(text: str, x: float, y: float, colour: Colour, align: float = 0.0) -> None:
    """
    Write a line of text.

    Parameters
    ----------
    x, y : of its base line
    align : what part of its width lies left of x
    """
    left = x - align * width_of(text) if align else x
    blf.size(FONT, SIZE * scale())
    blf.color(FONT, *colour)
    blf.position(FONT, left, y, 0)
    blf.draw(FONT, text)


def width_of(text: str) -> float:
    """Return how wide a line of text is [pixels]."""
    blf.size(FONT, SIZE * scale())
    return blf.dimensions(FONT, text)[0]


def shortened(text: str, room: float) -> str:
    """Return a text that is no wider than there is room [pixels]; what does not fit becomes an ellipsis."""
    if width_of(text) <= room:
        return text
    kept = next((n for n in range(len(text) - 1, 0, -1) if width_of(f"{text[:n].rstrip()}…") <= room), 0)
    return f"{text[:kept].rstrip()}…" if kept else ""


def broken(text: str, room: float) -> list[str]:
    """Return a text in lines that are no wider than there is room [pixels], broken between its words."""
    lines: list[str] = []
    for word in text.split(" "):
        if lines and width_of(f"{lines[-1]} {word}") <= room:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return [shortened(line, room) for line in lines]


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
