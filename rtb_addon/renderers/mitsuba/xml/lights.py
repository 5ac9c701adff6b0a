"""Lights as Mitsuba's emitters."""

from __future__ import annotations

import math
from xml.etree import ElementTree as Xml

import numpy as np

from ....errors import RecipeError
from ....scene.render_scene import Light
from ....spectra import FloatArray, Spectrum
from .camera import matrix
from .names import Names
from .spectrum import comment, element, format_spectrum

# The material of lamps' spheres: they emit and reflect nothing.
BLACK = "black"
Span = tuple[float, float]


def light(lamp: Light, names: Names, span: Span) -> list[Xml.Element]:
    """Return a lamp's elements; none if it is dark."""
    make = {"point": _point, "spot": _spot, "directional": _directional}.get(lamp.kind)
    if make is None:
        raise RecipeError(
            f"Mitsuba renders no {lamp.kind} light yet, make {lamp.id} point, spot or directional"
        )
    intensity = intensity_of(lamp)
    return make(lamp, intensity, names, span) if intensity.values.any() else []


def intensity_of(lamp: Light) -> Spectrum:
    """Return a lamp's intensity, in the unit of its kind."""
    intensity = lamp.parameters["intensity"]
    if not isinstance(intensity, Spectrum):
        raise RecipeError(f"light {lamp.id} needs a spectrum as its intensity")
    if intensity.values.min() < 0:
        raise RecipeError(f"light {lamp.id} has a negative intensity, give 0 or more")
    return intensity


def _number(lamp: Light, name: str) -> float:
    value = lamp.parameters.get(name, 0.0)
    if not isinstance(value, int | float) or not math.isfinite(value) or value < 0:
        raise RecipeError(f"light {lamp.id} has {value} as its {name}, give a number of 0 or more")
    return float(value)


def _point(lamp: Light, intensity: Spectrum, names: Names, span: Span) -> list[Xml.Element]:
    place, radius = names.of("emitter", lamp.id), _number(lamp, "radius")
    if radius == 0:
        node = element("emitter", "point", id=place)
        node.append(_xyz("point", "position", lamp.to_world[:3, 3]))
        node.append(format_spectrum("intensity", intensity, span))
        return [node]
    radiance = intensity.scaled(1 / (math.pi * radius**2))
    return [ball(place, lamp.to_world[:3, 3], radius, format_spectrum("radiance", radiance, span))]


def ball(place: str, centre: FloatArray, radius: float, radiance: Xml.Element) -> Xml.Element:
    """Return an emitting black sphere."""
    node = element("shape", "sphere", radius=radius)
    node.append(_xyz("point", "center", centre))
    node.append(Xml.Element("ref", id=BLACK))
    emitter = element("emitter", "area", id=place)
    emitter.append(radiance)
    node.append(emitter)
    return node


def _spot(lamp: Light, intensity: Spectrum, names: Names, span: Span) -> list[Xml.Element]:
    place, radius = names.of("emitter", lamp.id), _number(lamp, "radius")
    cone, blend = _number(lamp, "cone"), _number(lamp, "blend")
    if not 0 < cone <= 180 or blend > 1:
        raise RecipeError(
            f"spot {lamp.id} has a cone of {cone:g} degrees and blend {blend:g}, give 0 to 180 and 0 to 1"
        )
    outer = math.cos(math.radians(cone / 2))
    beam = math.degrees(math.acos(min(1.0, outer + (1 - outer) * blend))) if blend else cone / 2
    node = element("emitter", "spot", id=place, cutoff_angle=cone / 2, beam_width=beam)
    node.append(matrix("to_world", _facing(lamp)))
    node.append(format_spectrum("intensity", intensity, span))
    before = [comment(f"{place} fades by a smooth step over the cosine, in stock Mitsuba by a straight line")]
    if radius:
        before[0] = comment(f"{place} has a radius and a smooth edge, in stock Mitsuba it is a point")
        before.append(Xml.Element("default", name=f"{place}_radius", value=repr(radius)))
    return [*before, node]


def _directional(lamp: Light, intensity: Spectrum, names: Names, span: Span) -> list[Xml.Element]:
    place, angle = names.of("emitter", lamp.id), _number(lamp, "angle")
    if angle > 180:
        raise RecipeError(f"light {lamp.id} is {angle:g} degrees wide, give 180 at most")
    node = element("emitter", "directional", id=place)
    node.append(_xyz("vector", "direction", _facing(lamp)[:3, 2]))
    node.append(format_spectrum("irradiance", intensity, span))
    if angle == 0:
        return [node]
    said = comment(f"{place} is a disc in the sky, in stock Mitsuba a single direction")
    return [said, Xml.Element("default", name=f"{place}_angle", value=repr(angle)), node]


def _facing(lamp: Light) -> FloatArray:
    """Return a rigid matrix that stands where the lamp does and whose +Z axis is where it shines."""
    axis = -lamp.to_world[:3, 2]
    length = float(np.linalg.norm(axis))
    if not length > 0:
        raise RecipeError(f"light {lamp.id} is scaled to nothing along its axis and shines nowhere")
    axis = axis / length
    across = np.cross(np.eye(3)[np.abs(axis).argmin()], axis)
    across = across / np.linalg.norm(across)
    facing = np.eye(4)
    facing[:3, :3] = np.stack([across, np.cross(axis, across), axis], axis=1)
    facing[:3, 3] = lamp.to_world[:3, 3]
    return facing


def _xyz(tag: str, name: str, values: FloatArray) -> Xml.Element:
    x, y, z = (repr(float(value)) for value in values)
    return Xml.Element(tag, name=name, x=x, y=y, z=z)
