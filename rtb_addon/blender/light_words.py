"""
What light comes to, in words for the panels of lamps, worlds and meshes that shine.

A panel asks and gets what is there; what is not yet is worked out when Blender is idle, and drawn anew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import bpy

from ..errors import RecipeError
from .fields import typed_in
from .redrawing import redraw_panels

MOST = 64  # answers that are kept
ROWS = 5
_SHAPES = ("shadow_soft_size", "spot_size", "spot_blend", "angle", "shape", "size", "size_y")


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
_wanted: dict[tuple, Callable[[], Iterator[tuple[str, str]]]] = {}


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
    return _asked(key, partial(_of_lamp, _name_of(light), scene.name))


def told_surface(settings, measure: str, scene) -> Told:
    """Return what is known of the light of a world, or of a mesh that shines, for its amount in a measure."""
    key = typed_in(settings, "spectrum", scene.rtb), measure.upper(), settings.amount
    return _asked(key, partial(_of_surface, *key))


def _asked(key: tuple, work: Callable[[], Iterator[tuple[str, str]]]) -> Told:
    if key not in _told and key not in _wanted:
        _wanted[key] = work
        if not bpy.app.background and not bpy.app.timers.is_registered(_tell_and_redraw):
            bpy.app.timers.register(_tell_and_redraw)
    return _told.get(key, Told())


def _of_lamp(name: tuple[str, str | None], scene: str) -> Iterator[tuple[str, str]]:
    """Yield the rows of a lamp, of what it is called: it may have gone since it was asked about."""
    from .light_sums import lamp_rows  # numpy and what stands on it take longer than enabling may last

    if name in bpy.data.lights and scene in bpy.data.scenes:
        yield from lamp_rows(bpy.data.lights[name], bpy.data.scenes[scene])


def _of_surface(text: str, measure: str, amount: float) -> Iterator[tuple[str, str]]:
    from .light_sums import surface_rows

    yield from surface_rows(text, measure, amount)


def tell_wanted() -> int:
    """Work out what panels have asked for, and return how much that was."""
    wanted = dict(_wanted)
    _wanted.clear()
    if len(_told) + len(wanted) > MOST:
        _told.clear()
    for key, work in wanted.items():
        try:
            _told[key] = Told(tuple(work()))
        except (RecipeError, ValueError, OSError) as error:
            _told[key] = Told((), str(error))
    return len(wanted)


def _name_of(light) -> tuple[str, str | None]:
    """Return what Blender finds a lamp by, also where a linked one has the same name."""
    return light.name, None if light.library is None else light.library.filepath


def _tell_and_redraw() -> None:
    if tell_wanted():
        redraw_panels()


def unregister() -> None:
    """Forget everything."""
    if bpy.app.timers.is_registered(_tell_and_redraw):
        bpy.app.timers.unregister(_tell_and_redraw)
    _told.clear()
    _wanted.clear()
