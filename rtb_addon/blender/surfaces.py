"""What the mappings say about a material: its textures, its surface, and what goes around that."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from .materials import Paint, Pattern
from .statements import Named, Statement

Take = Callable[[str, str], str]


def statements(paint: Paint, id: str, take: Take, id_of: Callable[[str], str]) -> Iterator[Statement]:
    """
    Yield what the mappings say about a material; nothing where its colour is to be promoted.

    Parameters
    ----------
    id : of the material in the parent scene, which the outermost layer gets
    take : gives out a free id for a name and a suffix
    id_of : returns the id of another material by its name
    """
    if not paint.model:
        return
    name, here = paint.name, id
    if paint.opacity < 1:
        inner = take(f"{name}_inside", "-material")
        within = {"materialID": Named("string", inner)}
        yield Statement(here, name, "material", "mask", {}, {"opacity": paint.opacity}, within)
        here = inner
    if paint.relief is not None:
        # Under an id of its own it goes around the surface, wherever that is used.
        texture, around = take(f"{name}_relief", "-texture"), take(f"{name}_relief", "-material")
        yield _texture(texture, name, paint.relief.picture)
        within = {"materialID": Named("string", here), "textureID": Named("string", texture)}
        height = {"scale": paint.relief.scale} if paint.relief.model == "bumpmap" else {}
        yield Statement(around, name, "material", paint.relief.model, {}, height, within)
    used = {}
    for parameter, pattern in paint.textures.items():
        used[parameter] = take(f"{name}_{parameter}", "-texture")
        yield _texture(used[parameter], name, pattern)
    words = {
        **paint.words,
        **{parameter: Named("string", id_of(part)) for parameter, part in paint.parts.items()},
        **{parameter: Named("texture", texture) for parameter, texture in used.items()},
    }
    yield Statement(here, name, "material", paint.model, paint.spectra, paint.numbers, words)


def _texture(id: str, name: str, pattern: Pattern) -> Statement:
    return Statement(
        id, name, "spectrumTexture", pattern.model, pattern.spectra, pattern.numbers, pattern.words
    )
