"""The renderers that Blender offers: those that come along, and others once a test has found them."""

from __future__ import annotations

from collections.abc import Iterable

from ..errors import RecipeError

RENDERERS = (
    ("mitsuba", "Mitsuba", "Mitsuba 3, all bands along each path", 1),
    ("tracer", "Tracer", "The internal tracer, on numpy and Embree", 2),
)
_REFERENCE = (
    "sphere",
    "Sphere",
    "Matte spheres under point lights in closed form, to hold others against",
    3,
)
OURS = frozenset(each[0] for each in (*RENDERERS, _REFERENCE))

# Blender reads a list of choices where we keep it.
_offered = [*RENDERERS, _REFERENCE]


def choices(owner, context) -> list[tuple[str, str, str, int]]:
    """Return the items of a property that is a renderer."""
    return _offered


def learn(names: Iterable[str]) -> None:
    """Offer these too, which other packages bring; a name always has the same number in files."""
    from zlib import crc32  # only where there are others

    known = {each[0] for each in _offered}
    for name in names:
        if name not in known:
            number = 1 << 30 | crc32(name.encode()) >> 2
            _offered.append((name, name.title(), "Of another package", number))


def renderer_of(settings, whose: str) -> str:
    """Return the renderer that is chosen, or raise what to do where it is not known here."""
    if not settings.renderer:
        raise RecipeError(
            f"the renderer of {whose} is not known here, choose another, or point to it in the preferences"
        )
    return settings.renderer
