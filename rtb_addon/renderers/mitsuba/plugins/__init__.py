"""
Materials, textures and emitters that stock Mitsuba lacks, as plugins.

register() makes them known to plain Mitsuba as well.
"""

from __future__ import annotations

from types import ModuleType

from .blend import blend_plugin
from .picture import picture_plugin
from .sky import sky_plugin
from .ward import ward_plugin

_registered: set[str] = set()


def register(mi: ModuleType) -> None:
    """Make our plugins known to Mitsuba in its present variant, once."""
    # The classes that a plugin is derived from belong to one variant.
    if mi.variant() not in _registered:
        mi.register_bsdf("ward", ward_plugin(mi))
        mi.register_bsdf("fairblend", blend_plugin(mi))
        mi.register_texture("picture", picture_plugin(mi))
        mi.register_emitter("skypicture", sky_plugin(mi))
        _registered.add(mi.variant())
