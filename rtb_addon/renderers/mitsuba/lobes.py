"""
The spectra of materials, taken out of a native scene: what is left are one-hot colours.

A material's first spectrum becomes the colour (1, 0, 0), its second (0, 1, 0), its third (0, 0, 1): what
Mitsuba then computes are the coefficients of these spectra, its lobes, the same for every band and exactly
linear. Spectra that are the same share a lobe.

What a metal reflects is not linear in its index of refraction, but Fresnel's law needs nothing but that index
and the angle between two directions: a lobe of a metal has the coefficient of a perfect conductor, which
reflects everything, and the lobe path multiplies it by what each band's index reflects at that angle.

The principled material is linear but for a part that no spectrum multiplies, its clear reflection. All three
components hold that part, so one is kept free of spectra: what the others have beyond it are their lobes, and
it is a lobe of its own, a white one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as Xml

from ...errors import RenderingError
from ...spectra import Spectrum
from .material_trees import expanded, is_given, open_and_named, refuse_tints, spectra_of
from .xml.spectrum import element, parse_spectrum, properties

MOST_LOBES = 3
# Materials that are exactly linear in their spectra, which is what makes the lobe path exact, and the spectra
# that they have whether a scene names them or not.
_LINEAR: Mapping[str, Mapping[str, float]] = {
    "diffuse": {"reflectance": 0.5},
    "ward": {"diffuse_reflectance": 0.5, "specular_reflectance": 0.2},
    "conductor": {"specular_reflectance": 1.0},
    "roughconductor": {"specular_reflectance": 1.0},
    "plastic": {"diffuse_reflectance": 0.5, "specular_reflectance": 1.0},
    "roughplastic": {"diffuse_reflectance": 0.5, "specular_reflectance": 1.0},
    "dielectric": {"specular_reflectance": 1.0, "specular_transmittance": 1.0},
    "thindielectric": {"specular_reflectance": 1.0, "specular_transmittance": 1.0},
    "roughdielectric": {"specular_reflectance": 1.0, "specular_transmittance": 1.0},
    "principled": {"base_color": 0.5},
    "twosided": {},
    "bumpmap": {},
    "normalmap": {},
    "blendbsdf": {},
    "mask": {},
}

# What makes the principled material more than linear, by the square root of its colour.
_ROOT = ("spec_trans",)


class BeyondLobes(RenderingError):
    """A material is more than three lobes can carry."""


@dataclass(frozen=True, eq=False)
class PictureUse:
    """
    A picture on a surface, or around the scene.

    Parameters
    ----------
    file, gamma : of the picture
    wrap : what lies beyond its edges, a word of xml.textures.ALL_WRAPS
    nearest : whether texels are squares; else they fade into each other
    place : scale of U and of V, offset of U and of V
    """

    file: Path
    gamma: float
    wrap: str
    nearest: bool
    place: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Lobe:
    """
    What multiplies one of a material's coefficients, band by band.

    Parameters
    ----------
    reflectance : the spectrum
    index : eta and k of a metal, or None
    picture : what multiplies the spectrum, or None
    constant : whether this is the part that no spectrum multiplies, the last component
    """

    reflectance: Spectrum
    index: tuple[Spectrum, Spectrum] | None = None
    picture: PictureUse | None = None
    constant: bool = False


_CONSTANT = Lobe(Spectrum.constant(1.0), constant=True)


def take_lobes(root: Xml.Element) -> dict[str, list[Lobe]]:
    """Replace the spectra of all materials in a scene by one-hot colours; return their lobes by material."""
    return {id: _take(id, node) for id, node in expanded(root).items()}


def _take(id: str, material: Xml.Element) -> list[Lobe]:
    refuse_tints(id, material)
    for node in list(material.iter("bsdf")):
        _complete(id, node)
    open_and_named(material)
    metals = {node: _take_index(id, node) for node in material.iter("bsdf")}
    found: dict[tuple, Lobe] = {}
    places = []
    for parent, index, child in spectra_of(id, material):
        key = _content(child), *map(_content, metals.get(parent, ()))
        if key not in found:
            found[key] = _lobe(child, metals.get(parent, ()))
        places.append((parent, index, child.get("name", ""), key))
    constant = [_CONSTANT] if any(each.get("type") == "principled" for each in material.iter("bsdf")) else []
    if not 1 <= len(found) + len(constant) <= MOST_LOBES:
        raise BeyondLobes(f"{id} is made of {len(found)} spectra, give it 1 to {MOST_LOBES - len(constant)}")
    # Metals come first, so that few lobes have to be asked for their index.
    order = sorted(found, key=lambda key: found[key].index is None)
    for parent, index, name, key in places:
        parent[index] = one_hot_colour(name, order.index(key))
    return [*(found[key] for key in order), *constant]


def in_slots(lobes: Sequence[Lobe], count: int) -> list[Lobe | None]:
    """Return the lobes of a material by component of its colours, of which so many are looked at."""
    spectral = [lobe for lobe in lobes if not lobe.constant]
    constant = lobes[len(spectral) :]
    return [*spectral, *[None] * (count - len(lobes)), *constant]


def _lobe(node: Xml.Element, index: tuple[Xml.Element, ...]) -> Lobe:
    eta_and_k = [parse_spectrum(each) for each in index]
    metal = (eta_and_k[0], eta_and_k[1]) if index else None
    if node.tag == "spectrum":
        return Lobe(parse_spectrum(node), metal)
    return Lobe(Spectrum.constant(1.0), metal, picture_use(node))


def picture_use(node: Xml.Element) -> PictureUse:
    """Return what an element of type picture says."""
    said = properties(node)
    place = tuple(float(said[name]) for name in ("scale_u", "scale_v", "offset_u", "offset_v"))
    nearest = said["filter_type"] == "nearest"
    return PictureUse(Path(said["filename"]), float(said["gamma"]), said["wrap_mode"], nearest, place)


def _complete(id: str, node: Xml.Element) -> None:
    """Refuse what is not linear, and write out the spectra that Mitsuba would fill in as white or grey."""
    kind = node.get("type", "")
    given = {child.get("name") for child in node if is_given(child)}
    if kind not in _LINEAR or (kind == "principled" and given.intersection(_ROOT)):
        raise BeyondLobes(f"the native scene's {id} is a {kind}, make it one of {', '.join(_LINEAR)}")
    there = {child.get("name") for child in node}
    for name, value in _LINEAR[kind].items():
        if name not in there:
            node.append(element("spectrum", "uniform", name=name, value=value))


def _take_index(id: str, node: Xml.Element) -> tuple[Xml.Element, ...]:
    """Make a metal a perfect conductor, and return the elements of its eta and k; none of other materials."""
    found = {child.get("name"): child for child in node if child.get("name") in ("eta", "k", "material")}
    if "conductor" not in node.get("type", "") or "material" in found:
        if "material" in found and found["material"].get("value") != "none":
            raise BeyondLobes(f"the native scene's {id} names its metal, write eta and k as spectra")
        return ()
    try:
        taken = found["eta"], found["k"]
    except KeyError as missing:
        raise RenderingError(f"the native scene's {id} has no {missing.args[0]}, write a spectrum") from None
    for child in taken:
        node.remove(child)
    node.append(Xml.Element("string", name="material", value="none"))
    return taken


def _content(spectrum: Xml.Element) -> bytes:
    """Return what tells a spectrum from others, its name and the layout of the file aside."""
    return repr([spectrum.get("type"), *(sorted(child.items()) for child in spectrum)]).encode()


def one_hot_colour(name: str, lobe: int) -> Xml.Element:
    """Return the colour that stands for a lobe."""
    node = element("spectrum", "rawconstant", name=name)
    Xml.SubElement(node, "vector", name="value", value=", ".join("1" if k == lobe else "0" for k in range(3)))
    return node
