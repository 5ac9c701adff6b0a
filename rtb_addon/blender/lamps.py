"""Blender's lamps: what they are tagged with, else their colour, in radiometric units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..spectra import FULL_RANGE, Spectrum, Unit
from ..spectra.promotion import promoted
from . import lights
from .colours import linear_rec709
from .folders import typed
from .statements import Spoken, Statement

_KINDS = {"POINT": "point", "SPOT": "spot", "SUN": "directional", "AREA": "area"}
_UNITS = {
    "point": Unit.INTENSITY,
    "spot": Unit.INTENSITY,
    "directional": Unit.IRRADIANCE,
    "area": Unit.RADIANCE,
}


@dataclass(frozen=True)
class Lamp:
    """
    A lamp, read.

    Parameters
    ----------
    kind : a light of the vocabulary
    colour : linear Rec.709, white for a tagged one
    watts : its power [W], a sun's irradiance [W m-2]
    factor : from watts to what the kind is measured in; an area lamp's is for its own area
    spectrum : as typed; None for its colour
    numbers : further parameters of the vocabulary [m, degrees]
    shape, size : of an area lamp [scene units]
    remarks : what had to be assumed, a sentence each
    """

    name: str
    kind: str
    colour: tuple[float, float, float]
    watts: float
    factor: float
    spectrum: str | None
    numbers: Mapping[str, float]
    shape: str = ""
    size: tuple[float, float] = (0.0, 0.0)
    normalize: bool = True
    remarks: tuple[str, ...] = ()

    def statement(self, id: str, factor: float | None = None) -> Statement:
        """Return what the mappings say about it; an area lamp's factor depends on where it stands."""
        intensity = self._intensity(self.factor if factor is None else factor)
        return Statement(id, self.name, "light", self.kind, {"intensity": intensity}, self.numbers)

    @property
    def shown(self) -> tuple[float, float, float]:
        """Linear Rec.709 components of what it sends out, per nm, for readers without mappings."""
        scale = self.watts * self.factor / (FULL_RANGE[1] - FULL_RANGE[0])
        red, green, blue = (component * scale for component in self.colour)
        return red, green, blue

    def _intensity(self, factor: float) -> Spoken | Spectrum:
        unit = _UNITS[self.kind]
        if self.spectrum is not None:
            return Spoken(self.spectrum, f"the light {self.name}", unit, factor, self.watts)
        # White carries all the watts, and half of it half of them.
        width = FULL_RANGE[1] - FULL_RANGE[0]
        return promoted(self.colour).scaled(self.watts * factor / width, unit)


def read_lamp(light, meter: float) -> Lamp:
    """
    Return what a lamp sends out.

    Parameters
    ----------
    meter : length of the scene's unit [m]
    """
    name, kind, tagged = light.name_full, _KINDS[light.type], light.rtb.use_spectra
    strength = lights.watts(light.energy, light.exposure)
    factor, numbers = _closed_form(light, meter)
    return Lamp(
        name,
        kind,
        (1.0, 1.0, 1.0) if tagged else linear_rec709(lights.colour_of(light)),
        max(strength, 0.0),
        factor,
        typed(light.rtb.spectrum, light) if tagged else None,
        numbers,
        shape=light.shape if kind == "area" else "",
        size=_size(light) if kind == "area" else (0.0, 0.0),
        normalize=light.normalize,
        remarks=tuple(_remarks(light, strength)),
    )


def _closed_form(light, meter: float) -> tuple[float, dict[str, float]]:
    """Return the factor of a lamp's watts and the parameters of its kind."""
    if light.type == "SUN":
        factor = lights.sun_irradiance(light.angle, light.normalize)
        return factor, {"angle": math.degrees(light.angle)}
    if light.type == "AREA":
        return 1.0, {}
    radius = light.shadow_soft_size * meter
    factor = lights.point_intensity(radius, light.normalize)
    if light.type == "POINT":
        return factor, {"radius": radius}
    return factor, {"cone": math.degrees(light.spot_size), "blend": light.spot_blend, "radius": radius}


def _size(light) -> tuple[float, float]:
    return light.size, light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size


def _remarks(light, strength: float):
    name = f"the light {light.name_full}"
    if strength < 0:
        yield f"{name} has a negative power, which no lamp has: it is off"
    if not light.rtb.use_spectra:
        yield f"{name} has no spectrum: its colour is promoted to one that carries its power"
    elif min(lights.colour_of(light)) != 1.0 or max(lights.colour_of(light)) != 1.0:
        yield f"{name} shines in its spectrum, not in its colour"
    for clause in lights.unsupported(light):
        yield f"{name} is approximate: {clause}"
