"""Cameras as Mitsuba's sensors: any window, off its centre, of any pixel shape, mirrored or not."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any
from xml.etree import ElementTree as Xml

import numpy as np

from ....scene.render_scene import Camera, Film
from ....spectra import FloatArray
from .names import Names
from .spectrum import comment, element

# Mitsuba's cameras and spots look along +Z, ours along -Z; half a turn about Y takes one to the other.
HALF_TURN = np.diag([-1.0, 1.0, -1.0, 1.0])


def sensor(
    camera: Camera, film: Film, sampler: Xml.Element, film_node: Xml.Element, names: Names
) -> list[Xml.Element]:
    """Return the camera with its sampler and film, after what our renderer needs to know besides."""
    make = _perspective if camera.projection == "perspective" else _orthographic
    node, before = make(camera, film, names.of("camera", camera.id))
    node.extend([sampler, film_node])
    return [*before, node]


def matrix(name: str, values: FloatArray) -> Xml.Element:
    """Return a transform given by its (4, 4) matrix."""
    node = Xml.Element("transform", name=name)
    Xml.SubElement(node, "matrix", value=" ".join(repr(float(value)) for value in np.ravel(values)))
    return node


def _perspective(camera: Camera, film: Film, place: str) -> tuple[Xml.Element, list[Xml.Element]]:
    left, right, bottom, top = camera.window
    width, height = right - left, top - bottom
    # Stock Mitsuba believes that pixels are square; this is the height of its window.
    square = width * film.height / film.width
    shift = {"x": (left + right) / 2 / width, "y": -(bottom + top) / 2 / square}
    lens = camera.lens_radius > 0
    own: dict[str, Any] = {f"principal_point_offset_{axis}": part for axis, part in shift.items()}
    if lens:
        own = {"aperture_radius": float(camera.lens_radius), "focus_distance": float(camera.focus_distance)}
    node = element(
        "sensor",
        "thinlens" if lens else "perspective",
        id=place,
        fov=math.degrees(2 * math.atan(width / 2)),
        fov_axis="x",
        **own,
        near_clip=float(camera.clip[0]),
        far_clip=float(camera.clip[1]),
    )
    node.append(matrix("to_world", camera.to_world @ HALF_TURN))
    return node, [*_stretch(height / square), *(_shift(shift) if lens else [])]


def _stretch(stretch: float) -> list[Xml.Element]:
    if abs(stretch - 1) < 1e-9:
        return []
    said = "The pixels are not square, which stock Mitsuba cannot do: it shows another height of the view"
    return [comment(said), Xml.Element("default", name="pixel_stretch", value=repr(stretch))]


def _shift(shift: Mapping[str, float]) -> list[Xml.Element]:
    if max(map(abs, shift.values())) < 1e-12:
        return []
    said = "The lens looks past the middle of the picture, which in stock Mitsuba no lens of some width does"
    parts = [Xml.Element("default", name=f"shift_{axis}", value=repr(part)) for axis, part in shift.items()]
    return [comment(said), *parts]


def _orthographic(camera: Camera, film: Film, place: str) -> tuple[Xml.Element, list[Xml.Element]]:
    left, right, bottom, top = camera.window
    centre = np.eye(4)
    centre[:2, 3] = (left + right) / 2, (bottom + top) / 2
    # Mitsuba's view reaches from -1 to 1 across, and as far up as the film's shape says.
    size = np.diag([(right - left) / 2, (top - bottom) / 2 * film.width / film.height, 1.0, 1.0])
    node = element(
        "sensor",
        "orthographic",
        id=place,
        near_clip=float(camera.clip[0]),
        far_clip=float(camera.clip[1]),
    )
    node.append(matrix("to_world", camera.to_world @ centre @ HALF_TURN @ size))
    return node, []
