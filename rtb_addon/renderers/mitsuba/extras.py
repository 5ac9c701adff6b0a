"""Lines of a Mitsuba block: those that we understand so far, Mitsuba 0.5's names and 3's."""

from __future__ import annotations

import re
from dataclasses import replace

from ...errors import RecipeError
from ...scene.render_scene import Integrator
from ..interface import Extras, NativeLine

_DECLARATION = re.compile(r"\w[\w-]*:integrator:(\w+)")
_NUMBER = re.compile(r"\w[\w-]*:(\w+)\.integer\s*=?\s*(-?\d+)")
_FIELDS = {"maxdepth": "depth", "max_depth": "depth", "samplecount": "samples", "sample_count": "samples"}


def apply_extras(integrator: Integrator, extras: Extras) -> Integrator:
    """Return the integrator as the lines of a Mitsuba block change it."""
    for line in extras:
        integrator = _apply(integrator, line)
    return integrator


def _apply(integrator: Integrator, line: NativeLine) -> Integrator:
    text = line.text.strip()
    declared = _DECLARATION.fullmatch(text)
    if declared and declared[1] in ("path", "direct"):
        return replace(integrator, kind=declared[1])
    number = _NUMBER.fullmatch(text)
    if number and (field := _FIELDS.get(number[1].lower())):
        return replace(integrator, **{field: _positive(int(number[2]), number[1], line)})
    raise RecipeError(
        f"cannot use {text!r} in a Mitsuba block, only an integrator path or direct,"
        " its maxDepth and a sampler's sampleCount",
        line.file,
        line.line,
    )


def _positive(number: int, name: str, line: NativeLine) -> int:
    if number < 1:
        raise RecipeError(f"{name} is {number}, give 1 or more", line.file, line.line)
    return number
