"""
Lines of a Mitsuba block that say how a picture is computed, in words that every renderer understands.

A line is ``id:category:type``, which declares, or ``id:property.type = value``; RenderToolbox3 took
any of ``. : $`` between the parts (formats.md, scene targets).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import NamedTuple

from ..errors import RecipeError
from ..scene.render_scene import Integrator
from .interface import NativeLine

# Our own, and those of Mitsuba 0.5 that come to the same picture as path, with other noise.
INTEGRATORS = {
    "path": "path",
    "direct": "direct",
    "bdpt": "path",
    "volpath": "path",
    "volpath_simple": "path",
}
# What they change is the noise, so any of them may stand where a renderer has a sampler of its own.
SAMPLERS = (
    "independent",
    "stratified",
    "multijitter",
    "orthogonal",
    "ldsampler",
    "halton",
    "hammersley",
    "sobol",
)
# Settings that change the noise alone, or only how a sampler or integrator goes about it.
_NOISE = (
    *("shadingsamples", "emittersamples", "bsdfsamples", "rrdepth", "sampledirect", "lightimage"),
    *("pixelsamples", "dimension", "scramble", "seed"),
)
# Switches that every renderer here has off.
_OFF = ("ensureenergyconservation", "strictnormals", "hideemitters")
# Paths without an end are followed this far; beyond it there is hardly any light left, in Mitsuba's counting.
ENDLESS = 16


class NativeSetting(NamedTuple):
    """
    A native line taken apart.

    Parameters
    ----------
    id : of the object that it declares or changes
    name : category of a declaration, else the property
    kind : type of the object or of the value
    value : None in a declaration
    """

    id: str
    name: str
    kind: str
    value: str | None

    @property
    def is_sampler(self) -> bool:
        """Whether this is about a sampler; RenderToolbox3 names them CAMERA_sampler."""
        return self.name == "sampler" or self.id == "sampler" or self.id.endswith("_sampler")

    @property
    def is_integrator(self) -> bool:
        """Whether this is about the integrator."""
        return self.name == "integrator" or self.id == "integrator"


def parse_native_line(line: NativeLine) -> NativeSetting:
    """Return the parts of a native line; RecipeError when it has too few or too many."""
    target, equals, value = line.text.partition("=")
    parts = [part.strip() for part in re.split(r"[.:$]", target)]
    if len(parts) == 3 or (len(parts) == 2 and equals):
        return NativeSetting(
            parts[0], parts[1], parts[2] if len(parts) == 3 else "", value.strip() if equals else None
        )
    raise RecipeError(
        f"cannot read '{line.text}', want id:category:type or id:property.type = value", line.file, line.line
    )


def integrator_with(integrator: Integrator, lines: Iterable[NativeLine], renderer: str) -> Integrator:
    """Return the integrator as native lines change it; RecipeError for a line with no meaning here."""
    for line in lines:
        changes = _changes(parse_native_line(line), line, integrator)
        if changes is None:
            raise RecipeError(
                f"{renderer} has no use for '{line.text}', it knows the integrators path and direct,"
                " their maxDepth and a sampler's sampleCount",
                line.file,
                line.line,
            )
        integrator = replace(integrator, **changes)
    return integrator


def refused(lines: Iterable[NativeLine], renderer: str) -> Iterator[RecipeError]:
    """Yield what is wrong with native lines that a renderer would refuse when it translates a scene."""
    for line in lines:
        try:
            integrator_with(Integrator(), [line], renderer)
        except RecipeError as error:
            yield error


def _changes(setting: NativeSetting, line: NativeLine, integrator: Integrator) -> dict | None:
    if setting.value is None:
        return _declared(setting, integrator)
    name = setting.name.lower().replace("_", "")
    if setting.is_integrator and name == "maxdepth":
        return {"depth": ENDLESS if setting.value == "-1" else _count(setting, line)}
    if setting.is_sampler and name == "samplecount":
        return {"samples": _count(setting, line)}
    if name in _NOISE and (setting.is_integrator or setting.is_sampler):
        return {}
    return {} if name in _OFF and setting.value.lower() == "false" else None


def _declared(setting: NativeSetting, integrator: Integrator) -> dict | None:
    if setting.name == "integrator" and setting.kind in INTEGRATORS:
        kind = INTEGRATORS[setting.kind]
        # A recipe of direct light says nothing about how long paths are; Mitsuba's have no end.
        longer = kind == "path" and integrator.kind == "direct"
        return {"kind": kind, "depth": ENDLESS} if longer else {"kind": kind}
    if setting.name == "sampler" and setting.kind in SAMPLERS:
        return {}
    return {} if (setting.name, setting.kind) == ("rfilter", "box") else None


def _count(setting: NativeSetting, line: NativeLine) -> int:
    try:
        count = int(setting.value or "")
    except ValueError:
        count = 0
    if count < 1:
        raise RecipeError(
            f"{setting.name} is '{setting.value}', want a whole number above 0", line.file, line.line
        )
    return count
