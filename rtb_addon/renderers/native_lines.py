"""Lines of a Mitsuba block that say how a picture is taken, in words that every renderer understands."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

from ..errors import RecipeError
from ..scene.render_scene import Integrator, RenderScene
from .interface import NativeLine
from .native_optics import changed_optics, cropped, declared_optics
from .native_settings import NativeSetting, count_of, parse_native_line

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
_OFF = ("ensureenergyconservation", "strictnormals", "hideemitters", "highqualityedges", "sampleborder")
# Paths without an end are followed this far; beyond it there is hardly any light left, in Mitsuba's counting.
ENDLESS = 16


def scene_with(scene: RenderScene, lines: Iterable[NativeLine], renderer: str) -> RenderScene:
    """Return a scene as native lines change it; RecipeError for a line with no meaning here."""
    line = None
    for line in lines:
        scene = _changed(scene, line, renderer)
    return scene if line is None else replace(scene, film=cropped(scene.film, line))


def refused(scene: RenderScene, lines: Iterable[NativeLine], renderer: str) -> Iterator[RecipeError]:
    """Yield what is wrong with native lines that a renderer would refuse when it translates a scene."""
    line = None
    for line in lines:
        try:
            scene = _changed(scene, line, renderer)
        except RecipeError as error:
            yield error
    if line is not None:
        try:
            cropped(scene.film, line)
        except RecipeError as error:
            yield error


def _changed(scene: RenderScene, line: NativeLine, renderer: str) -> RenderScene:
    if (changes := _changes(parse_native_line(line), line, scene)) is None:
        raise RecipeError(
            f"{renderer} has no use for '{line.text}', it knows the integrators path and direct and their"
            " maxDepth, a sampler's sampleCount, a thin lens, filters and a film's crop",
            line.file,
            line.line,
        )
    return replace(scene, **changes)


def _changes(setting: NativeSetting, line: NativeLine, scene: RenderScene) -> dict[str, Any] | None:
    """Return what a line changes of a scene, None where it has no meaning."""
    if setting.value is None:
        return _declared(setting, scene)
    word = setting.word
    if setting.is_integrator and word == "maxdepth":
        depth = ENDLESS if setting.value == "-1" else count_of(setting, line)
        return {"integrator": replace(scene.integrator, depth=depth)}
    if setting.is_sampler and word == "samplecount":
        return {"integrator": replace(scene.integrator, samples=count_of(setting, line))}
    if (changed := changed_optics(setting, line, scene)) is not None:
        return changed
    same = word in _NOISE and (setting.is_integrator or setting.is_sampler)
    return {} if same or (word in _OFF and setting.value.lower() == "false") else None


def _declared(setting: NativeSetting, scene: RenderScene) -> dict[str, Any] | None:
    if setting.name == "integrator" and setting.kind in INTEGRATORS:
        return {"integrator": _integrator(INTEGRATORS[setting.kind], scene.integrator)}
    if setting.name == "sampler" and setting.kind in SAMPLERS:
        return {}
    return declared_optics(setting, scene)


def _integrator(kind: Any, integrator: Integrator) -> Integrator:
    # A recipe of direct light says nothing about how long paths are; Mitsuba's have no end.
    longer = kind == "path" and integrator.kind == "direct"
    return replace(integrator, kind=kind, depth=ENDLESS if longer else integrator.depth)
