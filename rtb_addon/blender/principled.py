"""
Blender's shaders in the words of the vocabulary, where a material has no spectra of its own.

Principled BSDF: metallic from half on is metal, transmission from half on is glass, a roughness of half or
more is matte, what is left is plastic. Roughness squared is the width of its GGX slopes, as in Cycles.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from .material_words import texture_of, words_of
from .nodes import colour_of_material, has_nodes, image_of, opacity_of, relief_of, surface_node

_MATTE_FROM = 0.5
_HALF = 0.5
# Where the index of a metal that shows a colour is worked out [nm]; straight lines between them.
_PLACES = (400, 460, 480, 500, 520, 545, 570, 590, 610, 700)
_BRIGHTEST = 0.98  # no metal reflects all, and the closed form has a pole there


@dataclass(frozen=True)
class Promoted:
    """
    What a material becomes.

    Parameters
    ----------
    model : of the vocabulary
    said : parameter -> what somebody would type, a number or a word
    images : parameter -> image of Blender that stands for it
    how : the end of a sentence: what it was promoted from, and what was left out
    relief : what tilts the surface, as relief_of() finds it
    opacity : part of the light that meets it
    """

    model: str
    said: Mapping[str, Any]
    images: Mapping[str, Any] = field(default_factory=dict)
    how: str = ""
    relief: tuple[str, Any, float] | None = None
    opacity: float = 1.0


def promoted_from(material) -> Promoted:
    """Return what a material's shader, else its viewport colour, comes to."""
    node = surface_node(material.node_tree) if has_nodes(material) else None
    return replace(_surface(material), relief=relief_of(node), opacity=opacity_of(node))


def _surface(material) -> Promoted:
    found = colour_of_material(material)
    node = surface_node(material.node_tree) if has_nodes(material) else None
    shown = " ".join(f"{each:.3g}" for each in _linear(found.colour))
    how = f"its {found.place} {shown} is promoted to"
    image = image_of(node, found.place) if found.textured else None
    if node is None or node.type != "BSDF_PRINCIPLED":
        return _matte(found, image, f"{how} a reflectance, matte")
    said = {socket.name: socket.default_value for socket in node.inputs if hasattr(socket, "default_value")}
    if said["Metallic"] >= _HALF:
        return _metal(found, said, f"{how} the index of a metal")
    if said.get("Transmission Weight", 0.0) >= _HALF:
        return _glass(found, said, f"{how} what a glass lets through")
    if said["Roughness"] >= _MATTE_FROM or said.get("Specular IOR Level", 0.5) <= 0:
        return _matte(found, image, f"{how} a reflectance, matte")
    return _plastic(found, image, said, f"{how} a reflectance, plastic")


def _matte(found, image, how: str) -> Promoted:
    images = {} if image is None else {"diffuseReflectance": image}
    return Promoted("matte", {"diffuseReflectance": in_words(found.colour)}, images, how)


def _plastic(found, image, said: Mapping, how: str) -> Promoted:
    rough = _slopes(said)
    typed = {"diffuseReflectance": in_words(found.colour), "intIOR": f"{_index(said):.4g}", **rough}
    images = {} if image is None else {"diffuseReflectance": image}
    return Promoted("roughplastic" if rough else "plastic", typed, images, how)


def _glass(found, said: Mapping, how: str) -> Promoted:
    # Cycles colours each surface by the square root, so that a body of two shows the colour.
    tint = in_words(tuple(each**0.5 for each in found.colour))
    rough = _slopes(said)
    typed = {"intIOR": f"{said['IOR']:.4g}", "specularTransmittance": tint, **rough}
    return Promoted("roughglass" if rough else "glass", typed, {}, how)


def _metal(found, said: Mapping, how: str) -> Promoted:
    """Return the metal whose reflectance, seen straight on, is the colour's, after Gulbrandsen 2014."""
    from ..spectra import Spectrum
    from ..spectra.promotion import promoted
    from ..spectra.text import format_spectrum

    rounded = [round(each, 3) for each in _linear(found.colour)]
    straight = promoted(rounded).at(_PLACES).clip(0, _BRIGHTEST)
    eta = (1 - straight) / (1 + straight)
    k = ((((eta + 1) ** 2 * straight - (eta - 1) ** 2) / (1 - straight)).clip(0)) ** 0.5
    eta, k = (format_spectrum(Spectrum.of(_PLACES, each.round(4))) for each in (eta, k))
    typed = {"eta": eta, "k": k, "roughness": 0.0, **_slopes(said)}
    return Promoted("metal", typed, {}, how)


def _slopes(said: Mapping) -> dict[str, Any]:
    """Return the roughness of the slopes; nothing for a polished surface."""
    width = said["Roughness"] ** 2
    return {"roughness": round(width, 4), "distribution": "ggx"} if width > 1e-4 else {}


def _index(said: Mapping) -> float:
    """Return the index of a clear coat as strong as Blender's, whose level scales that straight on."""
    straight = ((said["IOR"] - 1) / (said["IOR"] + 1)) ** 2 * 2 * said.get("Specular IOR Level", 0.5)
    root = min(straight, _BRIGHTEST) ** 0.5
    return (1 + root) / (1 - root)


def promote(material) -> str:
    """Give a material the spectra that its shader comes to, and return the sentence that says how."""
    promoted, settings = promoted_from(material), material.rtb
    settings.model = promoted.model
    for parameter, value in promoted.said.items():
        name = words_of(parameter).name
        is_text = settings.bl_rna.properties[name].type == "STRING"
        setattr(settings, name, f"{value:g}" if is_text and not isinstance(value, str) else value)
    for parameter, image in promoted.images.items():
        texture = getattr(settings, texture_of(words_of(parameter).name))
        texture.kind, texture.image = "bitmap", image
    settings.opacity = promoted.opacity
    if promoted.relief is not None:
        settings.detail, settings.detail_image, settings.detail_scale = promoted.relief
    return "; ".join((f"{material.name}: {promoted.how}", *left_out(material)))


def left_out(material) -> Iterator[str]:
    """Yield what of a material's Principled BSDF has no counterpart, a clause each."""
    node = surface_node(material.node_tree) if has_nodes(material) else None
    if node is None or node.type != "BSDF_PRINCIPLED":
        return
    for name in ("Subsurface Weight", "Coat Weight", "Sheen Weight", "Anisotropic", "Thin Film Thickness"):
        socket = node.inputs.get(name)
        if socket is not None and (socket.is_linked or socket.default_value > 0):
            yield f"its {name.lower()} is left out"
    normal, alpha = node.inputs["Normal"], node.inputs["Alpha"]
    if normal.is_linked and relief_of(node) is None:
        yield "what tilts its surface is left out"
    if alpha.is_linked:
        yield "its alpha is linked and counts as 1"


def in_words(colour: tuple[float, ...]) -> str:
    """Return the spectrum of a colour of Blender's as somebody would type it, one number for a grey."""
    # numpy takes longer to come than all else that enabling the extension waits for.
    from ..spectra.promotion import promoted
    from ..spectra.text import format_number, format_spectrum

    rounded = [round(component, 3) for component in _linear(colour)]
    return format_number(rounded[0]) if len(set(rounded)) == 1 else format_spectrum(promoted(rounded))


def _linear(colour) -> tuple[float, float, float]:
    from .colours import linear_rec709

    return linear_rec709(colour)
