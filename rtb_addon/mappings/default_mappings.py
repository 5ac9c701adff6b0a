"""Mappings for a scene from anywhere: every material a colour of the chart, every light daylight."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import cycle

from ..errors import RecipeError
from ..scene.collada.colours import read_lamp
from ..scene.document import Scene
from ..scene.paths import Element

# The chart's patches as RenderToolbox3 numbered them, down its columns.
CHART = tuple(f"mccBabel-{number}.spd" for number in range(1, 25))
DAYLIGHT = ("D65.spd",)


def default_mappings(
    document: Scene,
    *,
    reflectances: Sequence[str] = CHART,
    light_spectra: Sequence[str] = DAYLIGHT,
    exclude: str = "",
    include: str = "",
) -> str:
    """
    Return the text of a mappings file that gives every material and light of a scene a spectrum.

    Ids come in alphabetical order, and spectra one after the other, beginning anew when they run out.

    Parameters
    ----------
    reflectances, light_spectra : files or pairs such as ``300:0.5 800:0.5``
    exclude : a regular expression; ids that hold it are left alone
    include : a text that comes first, such as RenderToolbox3's mirroring of the camera
    """
    try:
        excluded = re.compile(exclude) if exclude else None
    except re.error as error:
        raise RecipeError(f"'{exclude}' is no regular expression: {error}") from error
    materials = _named(document.of_kind("material"), excluded)
    lights = _named(document.of_kind("light"), excluded)
    parts = [
        include.rstrip("\n") + "\n" if include else "",
        _block("materials", _materials(materials, reflectances)),
        _block("lights", _lights(lights, light_spectra)),
    ]
    return "\n".join(part for part in parts if part)


def _named(elements: Iterable[Element], excluded: re.Pattern[str] | None) -> list[tuple[str, Element]]:
    named = {id: each for each in elements if (id := each.get("id"))}
    return sorted((id, each) for id, each in named.items() if not (excluded and excluded.search(id)))


def _materials(materials: list[tuple[str, Element]], spectra: Sequence[str]) -> Iterator[str]:
    for (id, _), spectrum in zip(materials, cycle(spectra or ["300:0.5 800:0.5"]), strict=False):
        yield _lines(id, "material:matte", "diffuseReflectance", spectrum)


def _lights(lights: list[tuple[str, Element]], spectra: Sequence[str]) -> Iterator[str]:
    for (id, element), spectrum in zip(lights, cycle(spectra or ["300:1 800:1"]), strict=False):
        kind = read_lamp(element).kind
        # RenderToolbox3 made ambient lights directional, there is nothing like them.
        yield _lines(id, f"light:{'directional' if kind == 'ambient' else kind}", "intensity", spectrum)


def _lines(id: str, declared: str, name: str, spectrum: str) -> str:
    if re.search(r"[.:$={}\[\]<>\s]", id):
        return f"    % {id} cannot be named in a mapping, rename it in the modeller\n"
    return f"    {id}:{declared}\n    {id}:{name}.spectrum = {spectrum}\n"


def _block(title: str, entries: Iterator[str]) -> str:
    return f"% {title}\nGeneric {{\n" + "\n".join(entries) + "}\n"
