"""What each renderer makes of a material or world, in words, before anything is rendered."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..rtb_addon.blender.fields import is_number
from ..rtb_addon.blender.material_words import CHOICES, MODELS, is_typed, takes_texture, texture_of, words_of
from ..rtb_addon.blender.renderer_choices import RENDERERS
from ..rtb_addon.scene.vocabulary import MATERIALS
from .sentences import draw_sentence

TEXTURES = {"bitmap": "An image as a texture", "checkerboard": "A checkerboard"}
RELIEFS = {"bumpmap": "A bump map", "normalmap": "A normal map"}


def draw_renderers(layout, context, used: Sequence[tuple[str, str]]) -> None:
    """
    Draw each renderer with what is exact, approximate or absent in it.

    Parameters
    ----------
    used : features, as the table of what renderers can calls them, and in words
    """
    header, body = layout.panel("RTB_PT_in_the_renderers", default_closed=True)
    header.label(text="In the Renderers")
    if body is None:
        return
    for name, label, *_ in RENDERERS:
        column = body.column(align=True)
        levels = [(words, *_fidelity(name, feature)) for feature, words in used]
        absent = [f"{words} is absent" for words, level, _ in levels if level == "absent"]
        weaker = [told(*each) for each in levels if each[1] != "absent" and each[2]]
        column.label(text=f"{label}: {'absent' if absent else 'approximate' if weaker else 'exact'}")
        column.alert = bool(absent)
        for sentence in (*absent, *weaker):
            draw_sentence(column, sentence, context.region.width, "ERROR" if absent else "INFO")


def told(words: str, level: str, difference: str) -> str:
    """Return how something is rendered, as a sentence."""
    return f"{words}: {level}, {difference}"


def features(settings) -> Iterator[tuple[str, str]]:
    """Yield what a material uses: as the table of what renderers can calls it, and in words."""
    yield f"material {settings.model}", MODELS[settings.model][0]
    for name, parameter in MATERIALS[settings.model].items():
        value = getattr(settings, words_of(name).name)
        if name == "distribution" and value != "beckmann":
            yield f"distribution {value}", f"{CHOICES[value]} slopes"
        elif parameter.kind == "index" and is_typed(parameter.kind) and not is_number(value):
            yield "index spectrum", "An index that varies with wavelength"
        elif takes_texture(name, parameter.kind):
            kind = getattr(settings, texture_of(words_of(name).name)).kind
            if kind != "NONE":
                yield f"texture {kind}", TEXTURES[kind]
    if settings.detail != "NONE":
        yield f"material {settings.detail}", RELIEFS[settings.detail]
    if settings.model != "mask" and settings.opacity < 1:
        yield "material mask", "Opacity"


def _fidelity(renderer: str, feature: str):
    from ..rtb_addon.renderers.fidelity import fidelity  # brings numpy, which enabling need not wait for

    return fidelity(renderer, feature)
