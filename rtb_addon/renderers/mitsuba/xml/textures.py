"""Textures as Mitsuba's: checkerboards are its own, pictures a plugin of ours (see plugins/picture.py)."""

from __future__ import annotations

import math
import os
from pathlib import Path
from xml.etree import ElementTree as Xml

from ....errors import RecipeError
from ....scene.render_scene import Texture
from ....spectra import Spectrum
from .spectrum import element, format_spectrum

Span = tuple[float, float]
_FILTERS = {"nearest": "nearest", "bilinear": "bilinear", "trilinear": "bilinear", "ewa": "bilinear"}
WRAPS = ("repeat", "mirror", "clamp")
# The sky goes around: it repeats across, and ends at top and bottom.
AROUND = "around"
ALL_WRAPS = (*WRAPS, AROUND)


def texture(one: Texture, name: str, span: Span, folder: Path) -> Xml.Element:
    """Return a texture as the parameter of that name; files are named as seen from a folder."""
    if one.kind == "checkerboard":
        return _checkerboard(one, name, span)
    if one.kind == "bitmap":
        return _picture(one, name, folder)
    raise RecipeError(f"Mitsuba renders no {one.kind} texture, make {one.id} a bitmap or a checkerboard")


def _checkerboard(one: Texture, name: str, span: Span) -> Xml.Element:
    node = element("texture", "checkerboard", name=name)
    for mitsubas, ours in (("color0", "evenColor"), ("color1", "oddColor")):
        colour = one.parameters[ours]
        if not isinstance(colour, Spectrum) or colour.values.min() < 0:
            raise RecipeError(f"texture {one.id} needs a spectrum of 0 or more as its {ours}")
        node.append(format_spectrum(mitsubas, colour, span))
    # Mitsuba's board has two checks in each direction from 0 to 1.
    place = Xml.SubElement(node, "transform", name="to_uv")
    Xml.SubElement(place, "scale", x=_half(one, "checksPerU"), y=_half(one, "checksPerV"), z="1.0")
    Xml.SubElement(place, "translate", x=repr(finite(one, "offsetU")), y=repr(finite(one, "offsetV")))
    return node


def _picture(one: Texture, name: str, folder: Path) -> Xml.Element:
    filter, wrap = str(one.parameters["filterMode"]), wrap_of(one)
    if filter not in _FILTERS:
        raise RecipeError(f"texture {one.id} has filterMode {filter}, give one of {', '.join(_FILTERS)}")
    file = Path(os.path.relpath(str(one.parameters["filename"]), folder)).as_posix()
    numbers = {key: finite(one, key) for key in ("gamma", "scaleU", "scaleV", "offsetU", "offsetV")}
    return element(
        "texture",
        "picture",
        name=name,
        filename=file,
        wrap_mode=wrap,
        filter_type=_FILTERS[filter],
        gamma=numbers["gamma"],
        scale_u=numbers["scaleU"],
        scale_v=numbers["scaleV"],
        offset_u=numbers["offsetU"],
        offset_v=numbers["offsetV"],
    )


def wrap_of(one: Texture) -> str:
    """Return what lies beyond a picture's edges, in Mitsuba's words, which are ours."""
    wrap = str(one.parameters["wrapMode"])
    if wrap not in WRAPS:
        raise RecipeError(f"texture {one.id} has wrapMode {wrap}, give one of {', '.join(WRAPS)}")
    return wrap


def _half(one: Texture, name: str) -> str:
    return repr(finite(one, name) / 2)


def finite(one: Texture, name: str) -> float:
    """Return a number of a texture."""
    value = one.parameters[name]
    if not isinstance(value, int | float) or not math.isfinite(value):
        raise RecipeError(f"texture {one.id} has {value} as its {name}, give a number")
    return float(value)
