"""Materials as Mitsuba's BSDFs: opaque ones reflect on both sides, others stand for themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as Xml

from ...errors import RecipeError
from ...scene.render_scene import Material, RenderScene, Texture, TextureUse
from ...spectra import Spectrum
from .names import Names
from .spectrum_xml import comment, element, format_spectrum
from .textures_xml import texture
from .ward import VARIANTS


class _Writer(NamedTuple):
    """What it takes to write a material: names, the range of spectra, textures, and where the file goes."""

    names: Names
    span: tuple[float, float]
    textures: Mapping[str, Texture]
    folder: Path


# What other materials a material is made of, in the order in which Mitsuba wants them.
_PARTS = {"blend": ("materialID", "otherMaterialID"), "mask": ("materialID",)}
_WHITE = Spectrum.constant(1.0)
_SMOOTH = "dielectric"
_GLASSES = {"glass": _SMOOTH, "thinglass": "thindielectric", "roughglass": "roughdielectric"}
_BLENDED = "{} is shown too dark by stock Mitsuba 3.9 where it blends a mirror with something that is none"
_NEEDS = "{} needs a plugin of ours, rtb_addon.renderers.mitsuba.plugins registers it"
_PLUGINS = ("ward", "picture")


def materials(scene: RenderScene, names: Names, span: tuple[float, float], folder: Path) -> list[Xml.Element]:
    """Return every material of a scene, each after those that it is made of; files are seen from a folder."""
    for id in scene.materials:
        names.of("material", id)
    to = _Writer(names, span, scene.textures, folder)
    return [node for one in _in_order(scene.materials) for node in _material(one, to)]


def texture_of(material: str, scene: RenderScene) -> str:
    """Return a texture that a material uses, itself or in what it is made of; empty if it uses none."""
    one = scene.materials.get(material)
    if one is None:
        return ""
    own = (value.texture for value in one.parameters.values() if isinstance(value, TextureUse))
    parts = (texture_of(str(one.parameters[part]), scene) for part in _PARTS.get(one.model, ()))
    return next((found for found in (*own, *parts) if found), "")


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


def _material(one: Material, to: _Writer) -> list[Xml.Element]:
    place = to.names.known("material", one.id, "the scene")
    if one.model in _PARTS:
        return _composed(one, place, to.names)
    if one.model in _GLASSES:
        glass = _glass(one, place, to)
        return [*_remarks(place, glass), glass]
    make = _SURFACES.get(one.model)
    if make is None:
        known = ", ".join([*_SURFACES, *_GLASSES, *_PARTS])
        raise RecipeError(f"Mitsuba renders no {one.model} yet, make material {one.id} one of {known}")
    inner = make(one, to)
    both = element("bsdf", "twosided", id=place)
    both.append(inner)
    return [*_remarks(place, both), both]


def _remarks(place: str, node: Xml.Element) -> list[Xml.Element]:
    ours = any(each.get("type") in _PLUGINS for each in node.iter())
    return [comment(_NEEDS.format(place))] if ours else []


def _composed(one: Material, place: str, names: Names) -> list[Xml.Element]:
    """Return a material that is made of others."""
    if one.model == "blend":
        node = element("bsdf", "blendbsdf", id=place, weight=number(one, "weight", 0, 1))
    else:
        node = element("bsdf", "mask", id=place, opacity=number(one, "opacity", 0, 1))
    for part in _PARTS[one.model]:
        known = names.known("material", str(one.parameters[part]), f"material {one.id}")
        node.append(Xml.Element("ref", id=known))
    return [comment(_BLENDED.format(place)), node] if one.model == "blend" else [node]


def _matte(one: Material, to: _Writer) -> Xml.Element:
    node = element("bsdf", "diffuse")
    node.append(_colour(one, "diffuseReflectance", "reflectance", to))
    return node


def _mirror(one: Material, to: _Writer) -> Xml.Element:
    node = element("bsdf", "conductor", material="none")
    node.append(_colour(one, "specularReflectance", "specular_reflectance", to))
    return node


def _metal(one: Material, to: _Writer) -> Xml.Element:
    alpha = number(one, "roughness", 0, 10)
    rough: dict[str, Any] = {"distribution": "beckmann", "alpha": alpha} if alpha else {}
    node = element("bsdf", "roughconductor" if alpha else "conductor", **rough)
    node.extend([_colour(one, name, name, to) for name in ("eta", "k")])
    node.append(format_spectrum("specular_reflectance", _WHITE, to.span))
    return node


def _plastic(one: Material, to: _Writer) -> Xml.Element:
    # A rough surface without roughness is a smooth one, which Mitsuba has another plugin for.
    alpha = number(one, "roughness", 0, 10) if one.model == "roughplastic" else 0.0
    rough: dict[str, Any] = {"distribution": "beckmann", "alpha": alpha} if alpha else {}
    node = element("bsdf", "roughplastic" if alpha else "plastic", **_indices(one), nonlinear=False, **rough)
    node.append(_colour(one, "diffuseReflectance", "diffuse_reflectance", to))
    node.append(format_spectrum("specular_reflectance", _WHITE, to.span))
    return node


def _ward(one: Material, to: _Writer) -> Xml.Element:
    variant = one.parameters["variant"]
    if variant not in VARIANTS:
        raise RecipeError(f"material {one.id} is of variant {variant}, want one of {', '.join(VARIANTS)}")
    widths: dict[str, Any] = {f"alpha_{x.lower()}": number(one, f"alpha{x}", 1e-3, 10) for x in "UV"}
    node = element("bsdf", "ward", variant=variant, **widths)
    node.append(_colour(one, "diffuseReflectance", "diffuse_reflectance", to))
    node.append(_colour(one, "specularReflectance", "specular_reflectance", to))
    return node


_SURFACES = {
    "matte": _matte,
    "anisoward": _ward,
    "metal": _metal,
    "mirror": _mirror,
    "plastic": _plastic,
    "roughplastic": _plastic,
}


def _glass(one: Material, place: str, to: _Writer) -> Xml.Element:
    alpha = number(one, "roughness", 0, 10) if one.model == "roughglass" else 0.0
    rough: dict[str, Any] = {"distribution": "beckmann", "alpha": alpha} if alpha else {}
    kind = _SMOOTH if one.model == "roughglass" and not alpha else _GLASSES[one.model]
    indices = _indices(one)
    if alpha and indices["int_ior"] == indices["ext_ior"]:
        raise RecipeError(f"material {one.id} has the same index inside and outside, give it two that differ")
    node = element("bsdf", kind, id=place, **indices, **rough)
    node.append(_colour(one, "specularReflectance", "specular_reflectance", to))
    node.append(_colour(one, "specularTransmittance", "specular_transmittance", to))
    return node


def number(one: Material, name: str, low: float, high: float) -> float:
    """Return a number of a material that must lie in a range."""
    value = one.parameters[name]
    if not isinstance(value, int | float) or not math.isfinite(value) or not low <= value <= high:
        raise RecipeError(f"material {one.id} has {value} as its {name}, give a number from {low} to {high}")
    return float(value)


def _indices(one: Material) -> dict[str, Any]:
    return {"int_ior": number(one, "intIOR", 0.1, 10), "ext_ior": number(one, "extIOR", 0.1, 10)}


def _colour(one: Material, name: str, mitsubas: str, to: _Writer) -> Xml.Element:
    value = one.parameters[name]
    if isinstance(value, TextureUse) and name not in ("eta", "k"):
        if value.texture not in to.textures:
            raise RecipeError(
                f"material {one.id} uses texture {value.texture}, which the scene does not have"
            )
        return texture(to.textures[value.texture], mitsubas, to.span, to.folder)
    if not isinstance(value, Spectrum):
        raise RecipeError(f"material {one.id} needs a spectrum as its {name}")
    if value.values.min() < 0:
        raise RecipeError(f"material {one.id} has a negative {name}, give 0 or more")
    return format_spectrum(mitsubas, value, to.span)
