"""The picture that stands for a colour in a Collada effect."""

from __future__ import annotations

from typing import NamedTuple

from ..paths import Element, local_name
from .sources import child, children, text_of


class Picture(NamedTuple):
    """
    A texture of an effect.

    Parameters
    ----------
    image : id of an image of the document
    texcoord : name for the texture coordinates, bound where the geometry is used
    """

    image: str
    texcoord: str


def picture_in(effect: Element, colour: Element) -> Picture | None:
    """Return the picture that a colour of an effect is, or None; some exporters name the image at once."""
    texture = child(colour, "texture")
    if texture is None:
        return None
    parameters = {each.get("sid"): each for each in effect.iter("{*}newparam")}
    name = texture.get("texture", "")
    for _ in range(3):  # a sampler of a surface of an image
        if (parameter := parameters.get(name)) is None:
            break
        name = _source(parameter) or name
    return Picture(name, texture.get("texcoord", ""))


def image_file(image: Element) -> str:
    """Return the file that an image is, as the document writes it; empty where it is none."""
    start = child(image, "init_from")
    if start is None:
        return ""
    return text_of(child(start, "ref")) or text_of(start)


def uv_sets(link: Element, texcoords: dict[str, str]) -> dict[str, int]:
    """
    Return which set of texture coordinates each part of a geometry takes where it is used, by its symbol.

    Parameters
    ----------
    link : the instance_geometry
    texcoords : what the material of a symbol calls its texture coordinates
    """
    found: dict[str, int] = {}
    for bound in link.iter("{*}instance_material"):
        symbol = bound.get("symbol", "")
        inputs = [
            each
            for each in children(bound, "bind_vertex_input")
            if each.get("input_semantic", "TEXCOORD") == "TEXCOORD"
        ]
        named = [each for each in inputs if each.get("semantic") == texcoords.get(symbol)]
        if chosen := named or inputs:
            found[symbol] = int(chosen[0].get("input_set", 0))
    return found


def _source(parameter: Element) -> str:
    """Return what a sampler or a surface takes its picture from."""
    for each in parameter.iter("{*}source", "{*}init_from", "{*}instance_image"):
        if local_name(each) == "instance_image":
            return each.get("url", "").removeprefix("#")
        if text := text_of(each):
            return text
    return ""
