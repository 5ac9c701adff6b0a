"""Surfaces of one kind as Mitsuba's BSDFs."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as Xml

from ....errors import RecipeError
from ....scene.render_scene import Material, Texture, TextureUse
from ....scene.vocabulary import WARD_VARIANTS
from ....spectra import Spectrum
from .names import Names
from .spectrum import element, format_spectrum
from .textures import texture


class Writer(NamedTuple):
    """What it takes to write a material: names, the range of spectra, textures, and where the file goes."""

    names: Names
    span: tuple[float, float]
    textures: Mapping[str, Texture]
    folder: Path


DISTRIBUTIONS = ("beckmann", "ggx")
# Where the index of a glass is given that is given once [nm].
SODIUM = 589.3
_WHITE = Spectrum.constant(1.0)
_SMOOTH = "dielectric"
GLASSES = {"glass": _SMOOTH, "thinglass": "thindielectric", "roughglass": "roughdielectric"}


def _matte(one: Material, to: Writer) -> Xml.Element:
    node = element("bsdf", "diffuse")
    node.append(_colour(one, "diffuseReflectance", "reflectance", to))
    return node


def _mirror(one: Material, to: Writer) -> Xml.Element:
    node = element("bsdf", "conductor", material="none")
    node.append(_colour(one, "specularReflectance", "specular_reflectance", to))
    return node


def _metal(one: Material, to: Writer) -> Xml.Element:
    rough = _roughness(one)
    node = element("bsdf", "roughconductor" if rough else "conductor", **rough)
    node.extend([_colour(one, name, name, to) for name in ("eta", "k")])
    node.append(format_spectrum("specular_reflectance", _WHITE, to.span))
    return node


def _plastic(one: Material, to: Writer) -> Xml.Element:
    rough = _roughness(one) if one.model == "roughplastic" else {}
    node = element("bsdf", "roughplastic" if rough else "plastic", **_indices(one), nonlinear=False, **rough)
    node.append(_colour(one, "diffuseReflectance", "diffuse_reflectance", to))
    node.append(format_spectrum("specular_reflectance", _WHITE, to.span))
    return node


def _ward(one: Material, to: Writer) -> Xml.Element:
    variant = one.parameters["variant"]
    if variant not in WARD_VARIANTS:
        raise RecipeError(
            f"material {one.id} is of variant {variant}, want one of {', '.join(WARD_VARIANTS)}"
        )
    widths: dict[str, Any] = {f"alpha_{x.lower()}": number(one, f"alpha{x}", 1e-3, 10) for x in "UV"}
    node = element("bsdf", "ward", variant=variant, **widths)
    node.append(_colour(one, "diffuseReflectance", "diffuse_reflectance", to))
    node.append(_colour(one, "specularReflectance", "specular_reflectance", to))
    return node


def _principled(one: Material, to: Writer) -> Xml.Element:
    numbers: dict[str, Any] = {
        name: number(one, name, 0, 1) for name in ("metallic", "roughness", "specular")
    }
    node = element("bsdf", "principled", **numbers)
    node.append(_colour(one, "baseColor", "base_color", to))
    return node


def _measured(one: Material, to: Writer) -> Xml.Element:
    file = str(one.parameters["filename"])
    return element("bsdf", "measured", filename=Path(os.path.relpath(file, to.folder)).as_posix())


SURFACES = {
    "matte": _matte,
    "anisoward": _ward,
    "metal": _metal,
    "mirror": _mirror,
    "plastic": _plastic,
    "roughplastic": _plastic,
    "principled": _principled,
    "measured": _measured,
}


def glass(one: Material, place: str, to: Writer) -> Xml.Element:
    """Return a material of which light comes out again on the other side."""
    rough = _roughness(one) if one.model == "roughglass" else {}
    kind = _SMOOTH if one.model == "roughglass" and not rough else GLASSES[one.model]
    indices = _indices(one)
    if rough and indices["int_ior"] == indices["ext_ior"]:
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


def _roughness(one: Material) -> dict[str, Any]:
    """Return how rough a surface is; nothing where it is smooth, which Mitsuba has other plugins for."""
    alpha, slopes = number(one, "roughness", 0, 10), one.parameters.get("distribution", DISTRIBUTIONS[0])
    if slopes not in DISTRIBUTIONS:
        known = " or ".join(DISTRIBUTIONS)
        raise RecipeError(f"material {one.id} has {slopes} as its distribution, give {known}")
    return {"distribution": slopes, "alpha": alpha} if alpha else {}


def _indices(one: Material) -> dict[str, Any]:
    inside = one.parameters["intIOR"]
    if isinstance(inside, Spectrum):
        # Mitsuba's glass bends light of all wavelengths alike.
        one = replace(one, parameters={**one.parameters, "intIOR": float(inside.at(SODIUM))})
    return {"int_ior": number(one, "intIOR", 0.1, 10), "ext_ior": number(one, "extIOR", 0.1, 10)}


def texture_named(one: Material, id: str, to: Writer) -> Texture:
    """Return a texture that a material asks for."""
    if id not in to.textures:
        raise RecipeError(f"material {one.id} uses texture {id}, which the scene does not have")
    return to.textures[id]


def _colour(one: Material, name: str, mitsubas: str, to: Writer) -> Xml.Element:
    value = one.parameters[name]
    if isinstance(value, TextureUse) and name not in ("eta", "k"):
        return texture(texture_named(one, value.texture, to), mitsubas, to.span, to.folder)
    if not isinstance(value, Spectrum):
        raise RecipeError(f"material {one.id} needs a spectrum as its {name}")
    if value.values.min() < 0:
        raise RecipeError(f"material {one.id} has a negative {name}, give 0 or more")
    return format_spectrum(mitsubas, value, to.span)
