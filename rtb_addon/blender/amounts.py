"""
How much light a lamp sends out, where somebody measures it as people do: lm, cd, cd/m2, lx at a distance.

Each function returns the factor from that number to what a kind of light is measured in (intensity,
irradiance, radiance); numbers of the eye's and of watts have the same geometry.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from ..errors import RecipeError
from . import lights

MEASURES = (
    ("WATTS", "Watts", "As much as Blender's own power and exposure say", 0),
    ("LUMENS", "Lumens", "All light that leaves the lamp, as the eye weighs it", 1),
    ("CANDELAS", "Candelas", "Light in the lamp's main direction, as from a point", 2),
    ("NITS", "cd/m²", "How bright the lamp's surface looks", 3),
    ("LUX", "Lux", "Light that falls on a surface that faces the lamp", 4),
)
_UNITS = {"LUMENS": "lumens", "CANDELAS": "candelas", "NITS": "cd/m²", "LUX": "lux"}


def point(measure: str, numbers: Mapping[str, float], distance: float, owner: str) -> float:
    """Return the intensity, on the axis of a spot, for one unit of a measure; lengths in metres."""
    if measure == "LUMENS":
        angles = math.radians(numbers["cone"]) if "cone" in numbers else 0.0
        solid = lights.spot_solid_angle(angles, numbers["blend"]) if angles else 4 * math.pi
        return 1 / _some(solid, f"{owner} has no cone to send lumens into")
    if measure == "CANDELAS":
        return 1.0
    if measure == "LUX":
        return _some(distance, f"{owner} has its lux at a distance of 0, give it a distance") ** 2
    return (
        math.pi * _some(numbers["radius"], f"{owner} is a point without a luminance, give it a radius") ** 2
    )


def sun(measure: str, angle: float, owner: str) -> float:
    """Return the irradiance for one unit of a measure; the angle is the sun's diameter [degrees]."""
    if measure == "LUX":
        return 1.0
    if measure == "NITS":
        whole = math.radians(_some(angle, f"{owner} is a point without a luminance, give it an angle"))
        return math.pi * math.sin(whole / 2) ** 2
    raise RecipeError(f"{owner} is a sun, which has no {_UNITS[measure]}: give it lux or cd/m²")


def area(measure: str, shape: str, width: float, height: float, distance: float, owner: str) -> float:
    """Return the radiance for one unit of a measure; both sides or diameters, whatever the shape [m]."""
    whole = width * height * (math.pi / 4 if shape in ("DISK", "ELLIPSE") else 1.0)
    if measure == "LUMENS":
        return 1 / (math.pi * whole)
    if measure == "CANDELAS":
        return 1 / whole
    if measure == "NITS":
        return 1.0
    distance = _some(distance, f"{owner} has its lux at a distance of 0, give it a distance")
    return 1 / lights.area_on_axis(shape, width, height, distance)


def _some(number: float, sentence: str) -> float:
    if number <= 0:
        raise RecipeError(sentence)
    return number
