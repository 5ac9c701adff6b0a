"""Blender's materials: what they are tagged with, else what their shader comes to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import bpy

from ..errors import RecipeError
from ..scene.vocabulary import MATERIALS
from .colours import linear_rec709
from .fields import is_number, varies
from .folders import typed
from .images import gamma_of, picture_of
from .material_words import is_typed, takes_texture, texture_of, words_of
from .nodes import colour_of_material, glows
from .principled import Promoted, left_out, promoted_from
from .statements import Named, Picture, Spoken

# What lamps with a surface are made of.
BLACK = "Lamp Black"


@dataclass(frozen=True)
class Pattern:
    """A texture, read: a model of the vocabulary, and its parameters."""

    model: str
    spectra: Mapping[str, Spoken] = field(default_factory=dict)
    numbers: Mapping[str, float] = field(default_factory=dict)
    words: Mapping[str, Named | Picture] = field(default_factory=dict)


@dataclass(frozen=True)
class Relief:
    """What tilts a surface: bumpmap or normalmap, its picture, and how high it is [m]."""

    model: str
    picture: Pattern
    scale: float


@dataclass(frozen=True)
class Paint:
    """
    A material, read.

    Parameters
    ----------
    colour : linear Rec.709, what the parent scene shows
    model, spectra, numbers, words : of the vocabulary; no model where the colour is to be promoted
    parts : parameter -> name of the material that stands there
    textures : parameter -> what stands for it
    opacity : part of the light that meets the surface
    remarks : what had to be assumed, a sentence each
    """

    name: str
    colour: tuple[float, float, float]
    model: str = ""
    spectra: Mapping[str, Spoken] = field(default_factory=dict)
    numbers: Mapping[str, float] = field(default_factory=dict)
    words: Mapping[str, Named | Picture] = field(default_factory=dict)
    parts: Mapping[str, str] = field(default_factory=dict)
    textures: Mapping[str, Pattern] = field(default_factory=dict)
    relief: Relief | None = None
    opacity: float = 1.0
    remarks: tuple[str, ...] = ()


LAMP_BLACK = Paint(BLACK, (0.0, 0.0, 0.0), "matte", {"diffuseReflectance": Spoken("300:0 800:0", "black")})


def read_material(material, meter: float = 1.0) -> Paint:
    """
    Return what a material is tagged with, else what its shader comes to.

    Parameters
    ----------
    meter : length of the scene's unit [m]
    """
    colour = linear_rec709(colour_of_material(material).colour)
    read = _tagged if material.rtb.use_spectra else _promoted
    return read(material, colour, meter)


def parts_of(material) -> Iterator:
    """Yield the materials that a material is made of."""
    if material.rtb.use_spectra:
        for name, parameter in MATERIALS[material.rtb.model].items():
            part = getattr(material.rtb, words_of(name).name) if parameter.kind == "reference" else None
            if part is not None:
                yield part


def _tagged(material, colour: tuple[float, float, float], meter: float) -> Paint:
    settings, owner = material.rtb, f"the material {material.name_full}"
    spectra, numbers, words, parts, textures = {}, {}, {}, {}, {}
    for name, parameter in MATERIALS[settings.model].items():
        own = words_of(name).name
        value = getattr(settings, own)
        pattern = getattr(settings, texture_of(own)) if takes_texture(name, parameter.kind) else None
        if pattern is not None and pattern.kind != "NONE":
            textures[name] = _pattern(pattern, owner)
        elif is_typed(parameter.kind) and not (parameter.kind == "index" and is_number(value)):
            spectra[name] = Spoken(typed(value, material), owner)
        elif parameter.kind == "number" and isinstance(value, str) and varies(value):
            words[name] = Named("float", value)
        elif parameter.kind in ("number", "index"):
            numbers[name] = _number(value, words_of(name).label, owner)
        elif parameter.kind == "reference":
            parts[name] = _part(value, words_of(name).label, owner)
        elif name == "filename":
            words[name] = _measured(material, value, owner)
        else:
            words[name] = Named("string", value)
    relief = None
    if settings.detail != "NONE":
        relief = _relief(settings.detail, settings.detail_image, settings.detail_scale, owner, meter)
    opacity = 1.0 if settings.model == "mask" else settings.opacity
    remarks = tuple(_glowing(material))
    return Paint(
        *(material.name_full, colour, settings.model, spectra, numbers, words, parts, textures),
        relief=relief,
        opacity=opacity,
        remarks=remarks,
    )


def _promoted(material, colour: tuple[float, float, float], meter: float) -> Paint:
    """Return what a material without spectra comes to; a matte colour is left to the parent scene."""
    name, owner = material.name_full, f"the material {material.name_full}"
    promoted = promoted_from(material)
    clauses = "; ".join((promoted.how, *left_out(material)))
    remarks = (f"{owner} has no spectrum: {clauses}", *_textured(material, promoted), *_glowing(material))
    plain = not promoted.images and promoted.relief is None and promoted.opacity == 1
    if promoted.model == "matte" and plain:
        return Paint(name, colour, remarks=remarks)
    kinds = {key: each.kind for key, each in MATERIALS[promoted.model].items()}
    textures = {key: _bitmap(each, "repeat", owner) for key, each in promoted.images.items()}
    said = {key: value for key, value in promoted.said.items() if key not in textures}
    spectra = {key: Spoken(value, owner) for key, value in said.items() if kinds[key] == "spectrum"}
    numbers = {key: float(said[key]) for key in said if kinds[key] in ("number", "index")}
    words = {key: Named("string", said[key]) for key in said if kinds[key] == "text"}
    relief = _relief(*promoted.relief, owner, meter) if promoted.relief else None
    painted = Paint(name, colour, promoted.model, spectra, numbers, words, {}, textures)
    return replace(painted, relief=relief, opacity=promoted.opacity, remarks=remarks)


def _textured(material, promoted: Promoted) -> Iterator[str]:
    found = colour_of_material(material)
    if found.textured and not promoted.images:
        yield f"the material {material.name_full} has a texture for its {found.place}, which is not read"


def _glowing(material) -> Iterator[str]:
    if glows(material):
        yield f"the material {material.name_full} glows in Blender only: let its object emit to have it shine"


def _pattern(settings, owner: str) -> Pattern:
    """Return a texture that a material is tagged with."""
    if settings.kind == "checkerboard":
        thing = settings.id_data
        colours = {"evenColor": settings.even, "oddColor": settings.odd}
        spectra = {name: Spoken(typed(text, thing), owner) for name, text in colours.items()}
        checks = {"checksPerU": settings.checks[0], "checksPerV": settings.checks[1]}
        offsets = {"offsetU": settings.offset[0], "offsetV": settings.offset[1]}
        return Pattern("checkerboard", spectra, {**checks, **offsets})
    placed = {"offset": settings.offset, "scale": settings.scale}
    numbers = {f"{name}{axis}": two[at] for name, two in placed.items() for at, axis in enumerate("UV")}
    return _bitmap(settings.image, settings.wrap, owner, numbers)


def _bitmap(image, wrap: str, owner: str, numbers: Mapping[str, float] | None = None, raw=False) -> Pattern:
    """Return a texture that shows an image; a raw one's values count as they are, whatever space it names."""
    if image is None:
        raise RecipeError(f"{owner} has a texture without an image, choose one")
    words = {"filename": picture_of(image, owner), "wrapMode": Named("string", wrap)}
    return Pattern("bitmap", {}, {**(numbers or {}), "gamma": 1.0 if raw else gamma_of(image)}, words)


def _relief(model: str, image, height: float, owner: str, meter: float) -> Relief:
    return Relief(model, _bitmap(image, "repeat", owner, raw=True), height * meter)


def _measured(material, said: str, owner: str) -> Picture:
    """Return the file that a material was measured in."""
    if not said:
        raise RecipeError(f"{owner} needs a file of what was measured, choose one")
    file = Path(bpy.path.abspath(said, library=material.library))
    try:
        return Picture(file.name, file.read_bytes())
    except OSError as error:
        raise RecipeError(f"{owner} needs the file {file}, which cannot be read: {error.strerror}") from error


def _part(material, label: str, owner: str) -> str:
    if material is None:
        raise RecipeError(f"{owner} says nothing for {label}, choose a material")
    return material.name_full


def _number(value, label: str, owner: str) -> float:
    try:
        return float(value)
    except ValueError:
        raise RecipeError(f"{owner} has '{value}' for its {label}, which takes a number here") from None
