"""Films as Mitsuba's specfilm: a rectangular response of unit integral for each band."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree as Xml

import numpy as np

from ....scene.render_scene import Film
from .spectrum import element, regular

# A film that shows spectra at band centres gets bands as narrow as this around them [nm].
_NARROW = 1.0


def film(one: Film) -> Xml.Element:
    """Return the film as stock Mitsuba knows it, whose channels are the true means of their bands."""
    left, top, width, height = one.part
    crop = {"crop_offset_x": left, "crop_offset_y": top, "crop_width": width, "crop_height": height}
    size: dict[str, Any] = {"width": one.width, "height": one.height, **(crop if one.crop else {})}
    node = element("film", "specfilm", **size, component_format="float32")
    node.append(element("rfilter", one.filter))
    for index, (low, high) in enumerate(_responses(one)):
        height = repr(1 / (high - low))
        name = f"b{index:03d}_{one.bands.centres[index]:g}nm".replace(".", "_")
        node.append(regular(name, (low, high), f"{height}, {height}"))
    return node


def band_defaults(one: Film) -> list[Xml.Element]:
    """Return the bands as our renderer reads them."""
    facts = {
        "band_kind": one.band_kind,
        "band_centres": _words(one.bands.centres),
        "band_edges": _words(one.bands.edges),
    }
    return [Xml.Element("default", name=key, value=value) for key, value in facts.items()]


def _responses(one: Film) -> list[tuple[float, float]]:
    """Return where each channel of the stock film begins and ends [nm]."""
    if one.band_kind != "centre":
        return list(zip(one.bands.edges[:-1].tolist(), one.bands.edges[1:].tolist(), strict=True))
    half = min(_NARROW, float(one.bands.widths.min())) / 2
    return [(centre - half, centre + half) for centre in one.bands.centres.tolist()]


def _words(values: np.ndarray) -> str:
    return " ".join(repr(float(value)) for value in values)
