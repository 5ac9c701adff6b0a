"""
What a lamp's light comes to, in words for its panel.

A panel asks and gets what is there; what is not yet is worked out when Blender is idle, and drawn anew.
"""

from __future__ import annotations

from typing import NamedTuple

import bpy

from ..errors import RecipeError
from .fields import typed_in
from .own_spectra import heard
from .redrawing import redraw_panels

MOST = 64  # answers that are kept
ROWS = 5


class Told(NamedTuple):
    """
    What there is to tell.

    Parameters
    ----------
    rows : names and values, one below the other
    sentence : why there are none
    """

    rows: tuple[tuple[str, str], ...] = ()
    sentence: str = ""


_told: dict[tuple, Told] = {}
_wanted: dict[tuple, tuple[tuple[str, str | None], str]] = {}


def told(light, scene) -> Told:
    """Return what is known of a lamp's light; what is not known yet comes by itself."""
    settings = light.rtb
    key = (
        *(
            light.type,
            _name_of(light),
            typed_in(settings, "spectrum", scene.rtb),
            settings.measure,
            settings.amount,
        ),
        *(settings.distance, light.energy, light.exposure, light.normalize),
        *(getattr(light, name, 0) for name in _SHAPES),
        scene.unit_settings.scale_length,
    )
    if key not in _told and key not in _wanted:
        _wanted[key] = _name_of(light), scene.name
        if not bpy.app.background and not bpy.app.timers.is_registered(_tell_and_redraw):
            bpy.app.timers.register(_tell_and_redraw)
    return _told.get(key, Told())


_SHAPES = ("shadow_soft_size", "spot_size", "spot_blend", "angle", "shape", "size", "size_y")


def tell_wanted() -> int:
    """Work out what panels have asked for, and return how much that was."""
    wanted = dict(_wanted)
    _wanted.clear()
    if len(_told) + len(wanted) > MOST:
        _told.clear()
    for key, (light, scene) in wanted.items():
        if light in bpy.data.lights and scene in bpy.data.scenes:
            _told[key] = _found(bpy.data.lights[light], bpy.data.scenes[scene])
    return len(wanted)


def _name_of(light) -> tuple[str, str | None]:
    """Return what Blender finds a lamp by, also where a linked one has the same name."""
    return light.name, None if light.library is None else light.library.filepath


def _found(light, scene) -> Told:
    try:
        return Told(tuple(_rows(light, scene)))
    except (RecipeError, ValueError, OSError) as error:
        return Told((), str(error))


def _rows(light, scene):
    # numpy and what stands on it take longer to come than enabling may last.
    from dataclasses import replace

    from ..colour_rendering import rendering_index
    from ..photometry import lumens, temperature
    from ..spectra import Unit
    from .lamps import read_lamp

    units = scene.unit_settings
    meter = 1.0 if units.system == "NONE" else units.scale_length
    lamp = read_lamp(light, meter)
    text = typed_in(light.rtb, "spectrum", scene.rtb)
    shape = heard(text, Unit.SHAPE)
    kelvin, index = temperature(shape), rendering_index(shape)
    yield "CCT", "none" if kelvin is None else f"{kelvin[0]:.0f} K"
    yield "Duv", "none" if kelvin is None else f"{kelvin[1]:+.4f}"
    yield "CRI (Ra)", "none" if index is None else f"{index:.0f}"
    factor = lamp.factor
    if lamp.kind == "area":
        width, height = (side * meter for side in lamp.size)
        factor = lamp.area_factor(width, height, _area(lamp, meter))
    spoken = replace(lamp, spectrum=text).statement("", factor).spectra["intensity"]
    physical = spoken.meant(shape)
    name, radiometric, photometric = _QUANTITIES[lamp.kind]
    yield name, f"{in_digits(physical.integral())} {radiometric}"
    yield "", f"{in_digits(lumens(physical))} {photometric}"


def in_digits(value: float) -> str:
    """Return four digits of a number, without powers of ten as long as people read it."""
    rounded = float(f"{value:.4g}")
    return f"{rounded:.0f}" if 1e4 <= rounded < 1e7 else f"{rounded:.4g}"


def _area(lamp, meter: float) -> float:
    from .lights import area_of

    return area_of(lamp.shape, *lamp.size) * meter**2


_QUANTITIES = {
    "point": ("Intensity", "W/sr", "cd"),
    "spot": ("Intensity", "W/sr", "cd"),
    "directional": ("Irradiance", "W/m²", "lx"),
    "area": ("Radiance", "W/(sr m²)", "cd/m²"),
}


def _tell_and_redraw() -> None:
    if tell_wanted():
        redraw_panels()


def unregister() -> None:
    """Forget everything."""
    if bpy.app.timers.is_registered(_tell_and_redraw):
        bpy.app.timers.unregister(_tell_and_redraw)
    _told.clear()
    _wanted.clear()
