"""What a Collada file itself says about light and colour: effects and lamps."""

from __future__ import annotations

from typing import NamedTuple

from ..paths import Element, local_name
from .sources import child, extra_child, floats, number
from .textures import Picture, picture_in

Colour = tuple[float, float, float]
_SHADINGS = ("phong", "lambert", "blinn", "constant")
_LAMPS = ("point", "spot", "directional", "ambient")


class Effect(NamedTuple):
    """
    A material's colours, linear Rec.709.

    Parameters
    ----------
    diffuse : None where a texture or nothing stands for it
    emission : what it gives off
    picture : what stands for its diffuse colour, if a texture does
    """

    diffuse: Colour | None
    emission: Colour
    picture: Picture | None = None


NO_EFFECT = Effect(None, (0.0, 0.0, 0.0))


class Lamp(NamedTuple):
    """
    A lamp's own words.

    Parameters
    ----------
    kind : point, spot, directional or ambient
    colour : linear Rec.709
    numbers : parameters of the vocabulary that the lamp gives
    """

    kind: str
    colour: Colour
    numbers: dict[str, float]


def read_effect(effect: Element) -> Effect:
    """Return the colours of an effect's common profile."""
    technique = child(effect, "profile_COMMON", "technique")
    shading = None
    if technique is not None:
        shading = next((each for each in technique if local_name(each) in _SHADINGS), None)
    if shading is None:
        return NO_EFFECT
    diffuse = child(shading, "diffuse")
    picture = None if diffuse is None else picture_in(effect, diffuse)
    return Effect(_colour(diffuse), _colour(child(shading, "emission")) or (0.0, 0.0, 0.0), picture)


def read_lamp(light: Element) -> Lamp:
    """Return what a light says; ``falloff_angle`` is the whole cone, as Blender writes it."""
    common = child(light, "technique_common")
    found = [] if common is None else [each for each in common if local_name(each) in _LAMPS]
    if not found:
        raise ValueError(f"the light {light.get('id')} is none of {', '.join(_LAMPS)}")
    kind, colour = local_name(found[0]), _colour(found[0]) or (1.0, 1.0, 1.0)
    if kind != "spot":
        return Lamp(kind, colour, {})
    cone = number(child(found[0], "falloff_angle"), 180.0)
    blend = number(extra_child(light, "spotblend"), 0.0)
    return Lamp(kind, colour, {"cone": cone, "blend": blend})


def _colour(element: Element | None) -> Colour | None:
    if element is None or (colour := child(element, "color")) is None:
        return None
    numbers = floats(colour)
    if len(numbers) not in (3, 4):
        raise ValueError(f"a color holds {len(numbers)} numbers, want red, green and blue")
    return float(numbers[0]), float(numbers[1]), float(numbers[2])
