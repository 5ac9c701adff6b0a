"""
What each renderer makes of the vocabulary: exact, approximate (how), or absent.

Tests, ``check`` and the panels read this one table.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Literal, NamedTuple

from ..scene.render_scene import Film, Integrator, Light, Material, RenderScene, Texture, TextureUse
from ..spectra import Spectrum


class Fidelity(NamedTuple):
    """How true a renderer is to one word of the vocabulary, and what differs in a few words."""

    level: Literal["exact", "approximate", "absent"]
    difference: str = ""


EXACT = Fidelity("exact")
ABSENT = Fidelity("absent")
# Its sky is a picture, its sun a disc.
_IN_TEXELS = Fidelity("approximate", "the sky is seen in 512 x 256 directions, and as at 720 nm beyond")
# Mitsuba looks a measured surface up at a wavelength.
_AT_MIDDLES = Fidelity("approximate", "a band, or a tenth of one for the kind mean, is seen at its middle")

_BY_TENTHS = Fidelity("exact", "up to what varies within a tenth of a band")
# What a glass's maker writes beside its name.
_AT_SODIUM = Fidelity("approximate", "light of all wavelengths bends as that of 589.3 nm does")

# feature ("material matte", "light spot", "camera perspective" ...) -> renderer -> fidelity
TABLE: Mapping[str, Mapping[str, Fidelity]] = {
    "material matte": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "material anisoward": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "material metal": {"mitsuba": EXACT, "tracer": EXACT},
    "material glass": {"mitsuba": EXACT, "tracer": EXACT},
    "material thinglass": {"mitsuba": EXACT, "tracer": EXACT},
    "material roughglass": {"mitsuba": EXACT, "tracer": EXACT},
    "material mirror": {"mitsuba": EXACT, "tracer": EXACT},
    "material plastic": {"mitsuba": EXACT, "tracer": EXACT},
    "material roughplastic": {"mitsuba": EXACT, "tracer": EXACT},
    "material principled": {"mitsuba": EXACT},
    "material blend": {"mitsuba": EXACT, "tracer": EXACT},
    "material mask": {"mitsuba": EXACT, "tracer": EXACT},
    "material measured": {"mitsuba": _AT_MIDDLES},
    "material bumpmap": {"mitsuba": EXACT, "tracer": EXACT},
    "material normalmap": {"mitsuba": EXACT, "tracer": EXACT},
    "material fluorescent": {"tracer": EXACT},
    "light point": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "light spot": {"mitsuba": EXACT, "tracer": EXACT},
    "light directional": {"mitsuba": EXACT, "tracer": EXACT},
    "light area": {"mitsuba": EXACT, "tracer": EXACT},
    "light environment": {"mitsuba": EXACT, "tracer": EXACT},
    "light sunsky": {"mitsuba": _IN_TEXELS},
    "light environment picture": {"mitsuba": EXACT, "tracer": EXACT},
    "texture checkerboard": {"mitsuba": EXACT, "tracer": EXACT},
    "texture bitmap": {"mitsuba": EXACT, "tracer": EXACT},
    "camera perspective": {"mitsuba": EXACT, "tracer": EXACT},
    "camera orthographic": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "lens thin": {"mitsuba": EXACT, "tracer": EXACT},
    "film crop": {"mitsuba": EXACT, "tracer": EXACT},
    "integrator roulette": {"mitsuba": EXACT, "tracer": EXACT},
    "filter box": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "filter tent": {"mitsuba": EXACT, "tracer": EXACT},
    "filter gaussian": {"mitsuba": EXACT, "tracer": EXACT},
    "filter mitchell": {"mitsuba": EXACT, "tracer": EXACT},
    "filter catmullrom": {"mitsuba": EXACT, "tracer": EXACT},
    "filter lanczos": {"mitsuba": EXACT, "tracer": EXACT},
    "distribution beckmann": {"mitsuba": EXACT, "tracer": EXACT},
    "distribution ggx": {"mitsuba": EXACT, "tracer": EXACT},
    "index spectrum": {"mitsuba": _AT_SODIUM, "tracer": EXACT},
    "bands averaged": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "bands centre": {"mitsuba": EXACT, "tracer": EXACT, "sphere": EXACT},
    "bands mean": {"mitsuba": _BY_TENTHS, "tracer": _BY_TENTHS},
}


def fidelity(renderer: str, feature: str) -> Fidelity:
    """Return how true a renderer is to a feature; absent when the table does not list it."""
    return TABLE.get(feature, {}).get(renderer.lower(), ABSENT)


def unsupported(scene: RenderScene, renderer: str) -> list[str]:
    """Return a sentence for everything in a scene that a renderer lacks; none when it can render it."""
    return [
        f"{what}, which {renderer} cannot render; {_choices(renderer, feature)}"
        for feature, what in _features(scene)
        if fidelity(renderer, feature).level == "absent"
    ]


def _features(scene: RenderScene) -> Iterator[tuple[str, str]]:
    """Yield what a scene uses, as the table calls it and as a sentence begins."""
    for material in scene.materials.values():
        yield f"material {material.model}", f"material {material.id} is {material.model}"
        yield from _textures(material, scene.textures)
    for light in scene.lights:
        yield f"light {light.kind}", f"light {light.id} is {light.kind}"
    yield from _environment(scene.environment)
    yield f"camera {scene.camera.projection}", f"camera {scene.camera.id} is {scene.camera.projection}"
    if scene.camera.lens_radius:
        yield "lens thin", f"camera {scene.camera.id} has a lens of some width"
    yield from _settings(scene.film, scene.integrator)


def _settings(film: Film, integrator: Integrator) -> Iterator[tuple[str, str]]:
    yield f"bands {film.band_kind}", f"the band values are to be {film.band_kind}"
    yield f"filter {film.filter}", f"the reconstruction filter is {film.filter}"
    if film.crop:
        yield "film crop", "only a part of the picture is to be rendered"
    if integrator.roulette:
        yield "integrator roulette", f"paths may end at random from depth {integrator.roulette}"


def _textures(material: Material, textures: Mapping[str, Texture]) -> Iterator[tuple[str, str]]:
    if isinstance(material.parameters.get("intIOR"), Spectrum):
        yield "index spectrum", f"intIOR of material {material.id} is a spectrum"
    if material.parameters.get("distribution", "beckmann") != "beckmann":
        slopes = material.parameters["distribution"]
        yield f"distribution {slopes}", f"the distribution of material {material.id} is {slopes}"
    for name, value in material.parameters.items():
        if isinstance(value, TextureUse):
            kind = textures[value.texture].kind if value.texture in textures else "missing"
            yield f"texture {kind}", f"{name} of material {material.id} is texture {value.texture}"


def _environment(environment: Light | None) -> Iterator[tuple[str, str]]:
    if environment is None:
        return
    yield f"light {environment.kind}", f"the environment is {environment.kind}"
    if picture := environment.parameters.get("filename"):
        yield "light environment picture", f"the environment is the picture {picture}"


def _choices(renderer: str, feature: str) -> str:
    """Return what a renderer has instead of a feature it lacks."""
    room = feature.split()[0]
    known = [name.split(" ", 1)[1] for name in TABLE if name.startswith(f"{room} ")]
    there = [name for name in known if fidelity(renderer, f"{room} {name}").level != "absent"]
    return f"it knows {', '.join(there)}" if there else "give it a plain value"
