"""
The materials of a native scene, each a tree of all that it is made of.

Every path of ours needs them so: with copies in the place of references, with masks that are blends, and with
nothing in them that Mitsuba would compute from a luminance.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping
from xml.etree import ElementTree as Xml

from ...errors import RenderingError
from .xml.spectrum import element

# What Mitsuba makes of the luminance of a spectrum.
_LUMINANCE = ("spec_tint", "sheen_tint")


def expanded(root: Xml.Element) -> dict[str, Xml.Element]:
    """Return the materials of a scene by id, each with all that it is made of in it."""
    named = {node.get("id", ""): node for node in root.iter("bsdf") if node.get("id")}
    for node in named.values():
        _expand(node, named, (node.get("id", ""),))
    return named


def _expand(node: Xml.Element, named: Mapping[str, Xml.Element], above: tuple[str, ...]) -> None:
    """Put copies in the place of references: a spectrum is not the same lobe in every material."""
    for index, child in enumerate(list(node)):
        inside = above
        if child.tag == "ref" and (id := child.get("id", "")) in named:
            if id in above:
                raise RenderingError(f"the native scene's {id} refers to itself, give it another material")
            node[index] = child = copy.deepcopy(named[id])
            del child.attrib["id"]
            inside = (*above, id)
        if child.tag == "bsdf":
            _expand(child, named, inside)


def open_and_named(material: Xml.Element) -> None:
    """Turn masks into blends with nothing, and all blends into those of our plugin."""
    for node in list(material.iter("bsdf")):
        if node.get("type") == "mask":
            _open(node)
        if node.get("type") == "blendbsdf":
            _name_parts(node)


def _open(mask: Xml.Element) -> None:
    """
    Turn a mask into a blend with nothing.

    What a mask lets through has all colours at once, which no lobe has; glass that does not refract has one.
    """
    mask.set("type", "blendbsdf")
    for child in mask:
        if child.get("name") == "opacity":
            child.set("name", "weight")
    nothing = element("bsdf", "thindielectric", int_ior=1.0, ext_ior=1.0)
    for name in ("specular_reflectance", "specular_transmittance"):
        nothing.append(element("spectrum", "uniform", name=name, value=1.0))
    inner = next(index for index, child in enumerate(mask) if child.tag == "bsdf")
    mask.insert(inner, nothing)


def _name_parts(blend: Xml.Element) -> None:
    """Make a blend one of our plugin, which has mirrors right (see blend.py)."""
    blend.set("type", "fairblend")
    for child, name in zip(blend.findall("bsdf"), ("first", "second"), strict=True):
        child.set("name", name)


def refuse_tints(id: str, material: Xml.Element) -> None:
    """Refuse what Mitsuba makes of the luminance of a spectrum, which four bands do not have."""
    for node in material.iter("bsdf"):
        tints = [child.get("name") for child in node if child.get("name") in _LUMINANCE and is_given(child)]
        if tints:
            raise RenderingError(f"the native scene's {id} has a {tints[0]}, leave it at 0")


def spectra_of(id: str, material: Xml.Element) -> Iterator[tuple[Xml.Element, int, Xml.Element]]:
    """Yield the spectra and pictures of a material, each with what holds it and where it stands there."""
    for parent in list(material.iter()):
        for index, child in enumerate(list(parent)):
            if child.tag == "rgb" or (child.tag == "spectrum" and not child.get("type")):
                raise RenderingError(f"the native scene's {id} has a colour, write a regular spectrum")
            if child.tag == "spectrum" or child.get("type") == "picture":
                yield parent, index, child


def is_given(child: Xml.Element) -> bool:
    """Return whether a part of a material is there and is not the number 0."""
    return child.tag != "float" or float(child.get("value", 0)) != 0
