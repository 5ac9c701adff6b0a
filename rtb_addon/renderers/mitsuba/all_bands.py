"""
A native scene made ready for the all-bands path, for materials that no lobes can carry.

Mitsuba's own plugins then look spectra up, at a wavelength for each band: the middle of the band, or of a
part of it. So that they find there what the bands are to hold, every spectrum of a material becomes a table
of just these values. Emitters are as in the lobe path.
"""

from __future__ import annotations

from xml.etree import ElementTree as Xml

import numpy as np

from ...spectra import Bands, FloatArray
from .band_parts import divided
from .material_trees import expanded, open_and_named, refuse_tints, spectra_of
from .native import Native
from .one_hot import OneHotScene, bare, take_emitters
from .xml.spectrum import element, parse_spectrum, regular


def all_bands(native: Native) -> OneHotScene:
    """Return a native scene ready for the all-bands path."""
    root, beams = bare(native)
    emitters = take_emitters(root, native, beams)
    for node in [each for each in root.iter("spectrum") if each.get("type") == "rawconstant"]:
        _make_uniform(node)
    bands, kind = divided(native.bands, native.band_kind)
    materials = expanded(root)
    for id, material in materials.items():
        refuse_tints(id, material)
        open_and_named(material)
        for parent, index, child in list(spectra_of(id, material)):
            if child.tag == "texture":
                child.extend(_in_bands(bands, kind))
            else:
                values = parse_spectrum(child).in_bands(bands, kind)
                parent[index] = _table(child.get("name", ""), bands.centres, values)
    text = Xml.tostring(root, encoding="unicode")
    return OneHotScene(text, {id: [] for id in materials}, emitters, bands.centres)


def _make_uniform(node: Xml.Element) -> None:
    """Make a one-hot colour the number 1, which spectral variants take instead."""
    node[:] = []
    node.set("type", "uniform")
    Xml.SubElement(node, "float", name="value", value="1.0")


def _in_bands(bands: Bands, kind: str) -> list[Xml.Element]:
    """Return what tells a picture which bands to hold in the place of its channels."""
    facts = {"centres": _words(bands.centres), "edges": _words(bands.edges), "kind": kind}
    return [Xml.Element("string", name=f"band_{name}", value=value) for name, value in facts.items()]


def _table(name: str, places: FloatArray, values: FloatArray) -> Xml.Element:
    if not values.any():
        return element("spectrum", "uniform", name=name, value=0.0)
    if (values == values[0]).all():
        ends = float(places[0] - 1), float(places[-1] + 1)
        return regular(name, ends, _words(values[[0, 0]]))
    steps = np.diff(places)
    if np.ptp(steps) < 1e-6 * steps.mean():
        return regular(name, (places[0], places[-1]), _words(values))
    return element("spectrum", "irregular", name=name, wavelengths=_words(places), values=_words(values))


def _words(values: FloatArray) -> str:
    return " ".join(repr(float(value)) for value in values)
