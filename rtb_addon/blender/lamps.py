"""Blender's lamps: what they are tagged with, else their colour, in radiometric units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..photometry import lumens
from ..spectra import FULL_RANGE, Spectrum, Unit
from ..spectra.promotion import promoted
from . import amounts, lights
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
    factor : from watts, or its amount, to what the kind is measured in; not for area lamps
    lumens : its amount where that is measured as the eye weighs light, else None
    measure, distance : how that is measured, and how far away [m]
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
    lumens: float | None = None
    measure: str = "WATTS"
    distance: float = 1.0
    remarks: tuple[str, ...] = ()

    def area_factor(self, width: float, height: float, area: float) -> float:
        """Return an area lamp's factor for its sides [m] and area [m2] in the world."""
        if self.lumens is None:
            return lights.area_radiance(area, self.normalize)
        return amounts.area(self.measure, self.shape, width, height, self.distance, f"the light {self.name}")

    def statement(self, id: str, factor: float | None = None) -> Statement:
        """Return what the mappings say about it; an area lamp's factor depends on where it stands."""
        intensity = self._intensity(self.factor if factor is None else factor)
        return Statement(id, self.name, "light", self.kind, {"intensity": intensity}, self.numbers)

    @property
    def shown(self) -> tuple[float, float, float]:
        """Linear Rec.709 components of what it sends out, per nm, for readers without mappings."""
        flat = Spectrum.constant(1.0)
        amount = self.watts / flat.integral() if self.lumens is None else self.lumens / lumens(flat)
        scale = amount * self.factor
        red, green, blue = (component * scale for component in self.colour)
        return red, green, blue

    def _intensity(self, factor: float) -> Spoken | Spectrum:
        unit = _UNITS[self.kind]
        if self.spectrum is not None:
            owner, watts = f"the light {self.name}", self.watts if self.lumens is None else None
            return Spoken(self.spectrum, owner, unit, factor, watts, self.lumens)
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
    settings, distance = light.rtb, light.rtb.distance * meter
    measured = tagged and settings.measure != "WATTS"
    if measured:
        factor = _measured_factor(settings.measure, kind, numbers, distance, f"the light {name}")
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
        lumens=settings.amount if measured else None,
        measure=settings.measure if measured else "WATTS",
        distance=distance,
        remarks=tuple(_remarks(light, strength)),
    )


def _measured_factor(
    measure: str, kind: str, numbers: Mapping[str, float], distance: float, owner: str
) -> float:
    """Return the factor of an amount as the eye weighs it."""
    if kind == "area":
        return 1.0
    if kind == "directional":
        return amounts.sun(measure, numbers["angle"], owner)
    return amounts.point(measure, numbers, distance, owner)


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
    if light.rtb.use_spectra and light.rtb.measure != "WATTS" and light.rtb.amount <= 0:
        yield f"{name} has an amount of 0: it is off"
    for clause in lights.unsupported(light):
        yield f"{name} is approximate: {clause}"
