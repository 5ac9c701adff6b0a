"""Blender's world: it sends out light only where it is tagged."""

from __future__ import annotations

from ..spectra import Unit
from .folders import typed
from .nodes import is_black
from .statements import Spoken


def read_world(world) -> tuple[Spoken | None, tuple[str, ...]]:
    """Return the radiance that comes from all around, if any does, and what had to be assumed."""
    if world is None:
        return None, ()
    settings = world.rtb
    if settings.use_spectra:
        text = typed(settings.spectrum, world)
        return Spoken(text, f"the world {world.name_full}", Unit.RADIANCE, settings.amount), ()
    if is_black(world):
        return None, ()
    return None, (f"the world {world.name_full} has no spectrum and sends out no light, as if it were black",)
