"""Spectra in Mitsuba's XML, exactly: what is written is what is read, and what stock Mitsuba sees."""

from __future__ import annotations

from typing import cast
from xml.etree import ElementTree as Xml

import numpy as np

from ....errors import RenderingError
from ....spectra import FULL_RANGE, Bands, FloatArray, Spectrum

# Sample positions are compared in steps of a thousandth of a nanometre; a regular spectrum of more samples
# than this gives way to an irregular one, which is as exact and only slower in stock Mitsuba.
_TICK = 1e-3
_MOST_SAMPLES = 5000


def range_for(bands: Bands) -> tuple[float, float]:
    """Return the wavelengths [nm] that spectra must cover: 360-830 nm, and whatever bands lie beyond."""
    low = min(FULL_RANGE[0], 10 * float(np.floor(bands.edges[0] / 10)))
    high = max(FULL_RANGE[1], 10 * float(np.ceil(bands.edges[-1] / 10)))
    return low, high


def format_spectrum(name: str, spectrum: Spectrum, span: tuple[float, float]) -> Xml.Element:
    """
    Return a spectrum as an element that covers a span [nm], end values repeated.

    It is ``regular`` on the coarsest grid that holds every sample, ``irregular`` where no grid of 5000
    samples does, and ``uniform`` where it is zero, since Mitsuba refuses tables of zeros.
    """
    knots = _knots(spectrum, span)
    if not spectrum.at(knots).any():
        return element("spectrum", "uniform", name=name, value=0.0)
    step = _step(knots)
    count = round((span[1] - span[0]) / step) + 1
    if count > _MOST_SAMPLES:
        places, values = (_numbers(column) for column in (knots, spectrum.at(knots)))
        return element("spectrum", "irregular", name=name, wavelengths=places, values=values)
    values = _numbers(spectrum.at(np.linspace(*span, count)))
    return regular(name, span, values)


def regular(name: str, span: tuple[float, float], values: str) -> Xml.Element:
    """Return a regular spectrum over a span [nm]."""
    low, high = map(float, span)
    return element("spectrum", "regular", name=name, wavelength_min=low, wavelength_max=high, values=values)


def parse_spectrum(node: Xml.Element) -> Spectrum:
    """Return the spectrum that such an element holds."""
    kind, values = node.get("type"), properties(node)
    if kind == "uniform":
        return Spectrum.constant(float(values["value"]))
    if kind == "regular":
        heights = _parse_numbers(values["values"])
        places = np.linspace(float(values["wavelength_min"]), float(values["wavelength_max"]), len(heights))
        return Spectrum(places, heights)
    if kind == "irregular":
        return Spectrum(_parse_numbers(values["wavelengths"]), _parse_numbers(values["values"]))
    raise RenderingError(
        f"the native scene holds a spectrum of type {kind}, write it as regular, irregular or uniform"
    )


def element(tag: str, kind: str | None = None, *, name: str = "", id: str = "", **values) -> Xml.Element:
    """Return an element with a type, a name, an id and properties, each of its Python type."""
    node = Xml.Element(tag)
    for key, value in (("type", kind), ("id", id), ("name", name)):
        if value:
            node.set(key, value)
    for key, value in values.items():
        tag, text = _typed(value)
        Xml.SubElement(node, tag, name=key, value=text)
    return node


def comment(sentence: str) -> Xml.Element:
    """Return a comment; two hyphens in a row would end it."""
    node = Xml.Comment(f" {sentence.replace('--', '- -')} ")
    return cast("Xml.Element", node)


def plugin_remark(place: str) -> Xml.Element:
    """Return the comment that stands before what plain Mitsuba cannot load."""
    return comment(f"{place} needs a plugin of ours, rtb_addon.renderers.mitsuba.plugins registers it")


def properties(node: Xml.Element) -> dict[str, str]:
    """Return the plain properties of an element, as text."""
    return {child.get("name", ""): child.get("value", "") for child in node if child.get("value") is not None}


def _typed(value) -> tuple[str, str]:
    if isinstance(value, bool):
        return "boolean", "true" if value else "false"
    if isinstance(value, int):
        return "integer", str(value)
    if isinstance(value, float):
        return "float", repr(value)
    return "string", str(value)


def _knots(spectrum: Spectrum, span: tuple[float, float]) -> FloatArray:
    places = spectrum.wavelengths
    if (spectrum.values == spectrum.values[0]).all():
        return np.array(span)
    return np.array([span[0], *places[(places > span[0]) & (places < span[1])], span[1]])


def _step(knots: FloatArray) -> float:
    """Return the widest step of a grid that meets all knots [nm], or one too fine to use."""
    ticks = np.rint(knots / _TICK)
    if np.abs(knots - ticks * _TICK).max() > 1e-9:
        return _TICK
    return float(np.gcd.reduce(np.diff(ticks).astype(np.int64))) * _TICK


def _numbers(values: FloatArray) -> str:
    return ", ".join(repr(float(value)) for value in values)


def _parse_numbers(text: str) -> FloatArray:
    return np.array([float(word) for word in text.replace(",", " ").split()])
