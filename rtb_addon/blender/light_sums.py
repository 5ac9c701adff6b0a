"""What the light of a lamp or of a surface comes to: its colour, and how much of it there is."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..colour_rendering import rendering_index
from ..photometry import lumens, temperature
from ..spectra import Spectrum, Unit
from .fields import typed_in
from .lamps import read_lamp
from .lights import area_of
from .own_spectra import heard
from .statements import Spoken

_QUANTITIES = {
    "point": ("Intensity", "W/sr", "cd"),
    "spot": ("Intensity", "W/sr", "cd"),
    "directional": ("Irradiance", "W/m²", "lx"),
    "area": ("Radiance", "W/(sr m²)", "cd/m²"),
}


def lamp_rows(light, scene) -> Iterator[tuple[str, str]]:
    """Yield the names and values of what a lamp sends out."""
    units = scene.unit_settings
    meter = 1.0 if units.system == "NONE" else units.scale_length
    lamp = read_lamp(light, meter)
    text = typed_in(light.rtb, "spectrum", scene.rtb)
    shape = heard(text, Unit.SHAPE)
    yield from _colour(shape)
    factor = lamp.factor
    if lamp.kind == "area":
        width, height = (side * meter for side in lamp.size)
        factor = lamp.area_factor(width, height, area_of(lamp.shape, *lamp.size) * meter**2)
    spoken = replace(lamp, spectrum=text).statement("", factor).spectra["intensity"]
    yield from _amount(spoken.meant(shape), lamp.kind)


def surface_rows(text: str, measure: str, amount: float) -> Iterator[tuple[str, str]]:
    """Yield those of a world or a mesh; what a mesh's watts and lumens come to depends on its shape."""
    spectrum = heard(text, Unit.RADIANCE)
    yield from _colour(spectrum)
    if measure in ("RADIANCE", "NITS"):
        factor, weighed = (amount, None) if measure == "RADIANCE" else (1.0, amount)
        yield from _amount(Spoken(text, "", Unit.RADIANCE, factor, lumens=weighed).meant(spectrum), "area")


def _colour(light: Spectrum) -> Iterator[tuple[str, str]]:
    kelvin, index = temperature(light), rendering_index(light)
    yield "CCT", "none" if kelvin is None else f"{kelvin[0]:.0f} K"
    yield "Duv", "none" if kelvin is None else f"{kelvin[1]:+.4f}"
    yield "CRI (Ra)", "none" if index is None else f"{index:.0f}"


def _amount(physical: Spectrum, kind: str) -> Iterator[tuple[str, str]]:
    name, radiometric, photometric = _QUANTITIES[kind]
    yield name, f"{in_digits(physical.integral())} {radiometric}"
    yield "", f"{in_digits(lumens(physical))} {photometric}"


def in_digits(value: float) -> str:
    """Return four digits of a number, without powers of ten as long as people read it."""
    rounded = float(f"{value:.4g}")
    return f"{rounded:.0f}" if 1e4 <= rounded < 1e7 else f"{rounded:.4g}"
