"""Materials as Mitsuba's BSDFs: opaque ones reflect on both sides, others stand for themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree as Xml

from ....errors import RecipeError
from ....scene.render_scene import Material, RenderScene, TextureUse
from .names import Names
from .relief import heights, normals
from .spectrum import comment, element, plugin_remark
from .surfaces import GLASSES, SURFACES, Writer, glass, number, texture_named

# What other materials a material is made of, in the order in which Mitsuba wants them.
_PARTS = {
    "blend": ("materialID", "otherMaterialID"),
    "mask": ("materialID",),
    "bumpmap": ("materialID",),
    "normalmap": ("materialID",),
}
_BLENDED = "{} is shown too dark by stock Mitsuba 3.9 where it blends a mirror with something that is none"
_PLUGINS = ("ward", "picture")


def materials(scene: RenderScene, names: Names, span: tuple[float, float], folder: Path) -> list[Xml.Element]:
    """Return every material of a scene, each after those that it is made of; files are seen from a folder."""
    for id in scene.materials:
        names.of("material", id)
    to = Writer(names, span, scene.textures, folder)
    return [node for one in _in_order(scene.materials) for node in _material(one, to)]


def texture_of(material: str, scene: RenderScene) -> str:
    """Return a texture that a material uses, itself or in what it is made of; empty if it uses none."""
    one = scene.materials.get(material)
    if one is None:
        return ""
    own = (value.texture for value in one.parameters.values() if isinstance(value, TextureUse))
    relief = str(one.parameters.get("textureID", ""))
    parts = (texture_of(str(one.parameters[part]), scene) for part in _PARTS.get(one.model, ()))
    return next((found for found in (*own, relief, *parts) if found), "")


def _in_order(declared: Mapping[str, Material]) -> Iterator[Material]:
    done: set[str] = set()

    def visit(id: str, above: tuple[str, ...]) -> Iterator[Material]:
        if id in above:
            raise RecipeError(f"material {id} is made of itself, give {above[-1]} another material")
        if id in done or id not in declared:
            return
        for part in _PARTS.get(declared[id].model, ()):
            yield from visit(str(declared[id].parameters[part]), (*above, id))
        done.add(id)
        yield declared[id]

    for id in declared:
        yield from visit(id, ())


def _material(one: Material, to: Writer) -> list[Xml.Element]:
    place = to.names.known("material", one.id, "the scene")
    if one.model in _PARTS:
        return _composed(one, place, to)
    if one.model in GLASSES:
        clear = glass(one, place, to)
        return [*_remarks(place, clear), clear]
    make = SURFACES.get(one.model)
    if make is None:
        known = ", ".join([*SURFACES, *GLASSES, *_PARTS])
        raise RecipeError(f"Mitsuba renders no {one.model} yet, make material {one.id} one of {known}")
    inner = make(one, to)
    both = element("bsdf", "twosided", id=place)
    both.append(inner)
    return [*_remarks(place, both), both]


def _remarks(place: str, node: Xml.Element) -> list[Xml.Element]:
    ours = any(each.get("type") in _PLUGINS for each in node.iter())
    return [plugin_remark(place)] if ours else []


def _composed(one: Material, place: str, to: Writer) -> list[Xml.Element]:
    """Return a material that is made of others."""
    node = _COMPOSED[one.model](one, place, to)
    for part in _PARTS[one.model]:
        known = to.names.known("material", str(one.parameters[part]), f"material {one.id}")
        node.append(Xml.Element("ref", id=known))
    return [comment(_BLENDED.format(place)), node] if one.model == "blend" else [node]


def _blend(one: Material, place: str, to: Writer) -> Xml.Element:
    return element("bsdf", "blendbsdf", id=place, weight=number(one, "weight", 0, 1))


def _mask(one: Material, place: str, to: Writer) -> Xml.Element:
    return element("bsdf", "mask", id=place, opacity=number(one, "opacity", 0, 1))


def _bumps(one: Material, place: str, to: Writer) -> Xml.Element:
    node = element("bsdf", "bumpmap", id=place, scale=number(one, "scale", -1e6, 1e6))
    node.append(heights(texture_named(one, str(one.parameters["textureID"]), to), to.folder))
    return node


def _normals(one: Material, place: str, to: Writer) -> Xml.Element:
    node = element("bsdf", "normalmap", id=place)
    node.append(normals(texture_named(one, str(one.parameters["textureID"]), to), to.folder))
    return node


_COMPOSED = {"blend": _blend, "mask": _mask, "bumpmap": _bumps, "normalmap": _normals}
