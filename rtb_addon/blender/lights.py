"""
Blender's lamps as radiometric quantities: closed forms, checked against Cycles.

Each function returns the factor that turns a lamp's spectral power, watts times a shape of integral 1
[W nm-1], into what renderers want. Watts stay watts whatever the scene's unit; lengths are metres here, so
that a scene whose unit is not the metre gets the light that its size in metres asks for. ``normalize`` is
Blender's switch of that name: off, a lamp's power is per area of the lamp.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from .nodes import has_nodes

# Lamps' numbers that mean nothing physical, and what they must be.
_FACTORS = ("diffuse_factor", "specular_factor", "transmission_factor", "volume_factor")


def watts(energy: float, exposure: float = 0.0) -> float:
    """Return a lamp's power [W] (a sun's irradiance [W m-2]) from Blender's numbers."""
    return energy * 2.0**exposure


def point_intensity(radius: float = 0.0, normalize: bool = True) -> float:
    """Return the radiant intensity per watt [sr-1] of a point lamp, or on the axis of a spot lamp."""
    if normalize:
        return 1.0 / (4.0 * math.pi)
    return radius**2 if radius > 0 else 1.0 / math.pi


def sun_irradiance(angle: float = 0.0, normalize: bool = True) -> float:
    """
    Return the irradiance, on a surface that faces the sun, per strength of the sun.

    Parameters
    ----------
    angle : the sun's diameter [rad]
    """
    if normalize or angle <= 0:
        return 1.0
    return math.pi * math.sin(angle / 2) ** 2


def area_radiance(area: float, normalize: bool = True) -> float:
    """Return the radiance per watt [m-2 sr-1] of an area lamp or a surface, Lambertian and one-sided."""
    return 1.0 / (math.pi * area) if normalize else 1.0 / math.pi


def area_of(shape: str, width: float, height: float) -> float:
    """Return the area of a lamp's shape: square, rectangle, disk or ellipse."""
    sides = width * (height if shape in ("RECTANGLE", "ELLIPSE") else width)
    return sides * (math.pi / 4 if shape in ("DISK", "ELLIPSE") else 1.0)


def area_on_axis(shape: str, width: float, height: float, distance: float) -> float:
    """
    Return what a radiance is multiplied by to be the irradiance that faces a lamp's middle [sr].

    Parameters
    ----------
    width, height : sides or diameters, both, whatever the shape [m]
    distance : from the lamp [m]
    """
    a, b = width / 2, height / 2
    if shape in ("DISK", "ELLIPSE"):
        return math.pi * a * b / math.sqrt((a * a + distance**2) * (b * b + distance**2))
    across, along = math.hypot(a, distance), math.hypot(b, distance)
    return 2 * (a / across * math.atan(b / across) + b / along * math.atan(a / along))


def spot_solid_angle(cone: float, blend: float) -> float:
    """Return what the intensity on a spot's axis is multiplied by to be its power [sr]."""
    return 2 * math.pi * (1 - math.cos(cone / 2)) * (1 - blend / 2)


def smooth_edge(cosine: float, cone: float, blend: float) -> float:
    """
    Return how much of its intensity a spot lamp sends in a direction, by Blender's smooth step.

    Parameters
    ----------
    cosine : of the angle to the axis
    cone : the full angle [rad]
    """
    rim = math.cos(cone / 2)
    if cosine <= rim:
        return 0.0
    step = min((cosine - rim) / max((1.0 - rim) * blend, 1e-12), 1.0)
    return step * step * (3.0 - 2.0 * step)


def colour_of(light) -> tuple[float, float, float]:
    """Return a lamp's colour in Blender's working space, times that of its temperature if it has one."""
    tint = light.temperature_color if light.use_temperature else (1.0, 1.0, 1.0)
    red, green, blue = (own * warm for own, warm in zip(light.color, tint, strict=True))
    return red, green, blue


def unsupported(light) -> Iterator[str]:
    """Yield what a lamp has that no physical lamp has, or that no renderer here knows, a clause each."""
    for name in _FACTORS:
        if getattr(light, name, 1.0) != 1.0:
            yield f"its {name.replace('_', ' ')} counts as 1"
    if not light.use_shadow:
        yield "it casts shadows all the same"
    if light.type == "AREA" and light.spread < math.pi - 1e-5:
        yield "it spreads over the whole half space"
    if light.type in ("POINT", "SPOT") and light.shadow_soft_size > 0 and light.use_soft_falloff:
        yield "it is a sphere, without Blender's soft falloff close to it"
    if has_own_nodes(light):
        yield "its nodes are not read, its power and colour are"


def has_own_nodes(light) -> bool:
    """Return whether a lamp's nodes do more than pass its power on."""
    if not has_nodes(light):
        return False
    nodes = [node for node in light.node_tree.nodes if node.type not in ("OUTPUT_LIGHT", "FRAME", "REROUTE")]
    return not all(node.type == "EMISSION" and _is_plain(node) for node in nodes)


def _is_plain(emission) -> bool:
    inputs = emission.inputs
    linked = any(socket.is_linked for socket in inputs)
    return (
        not linked and inputs["Strength"].default_value == 1.0 and min(inputs["Color"].default_value) == 1.0
    )
