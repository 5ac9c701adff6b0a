"""
Which texels of a picture a place on a surface is made of, and how much of each.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import drjit as dr
import mitsuba as mi

from .xml.textures import ALL_WRAPS, AROUND

_MIRROR, _CLAMP, _AROUND = (ALL_WRAPS.index(word) for word in ("mirror", "clamp", AROUND))


class Layout(NamedTuple):
    """
    Where a picture lies in memory and on the surface, each a number of Mitsuba's for every path.

    Parameters
    ----------
    first, width, height : of its texels, row 0 on top
    wrap : number of its word in xml.textures.ALL_WRAPS
    nearest : 1 takes the nearest texel alone, 0 the four around
    place : scale of U and of V, offset of U and of V
    """

    first: Any
    width: Any
    height: Any
    wrap: Any
    nearest: Any
    place: Any


def taps(layout: Layout, uv) -> list[tuple[Any, Any]]:
    """Return the four texels around a place, each as its index and its share."""
    u = layout.place.x * uv.x + layout.place.z
    # V grows upwards, rows are counted from the top.
    v = 1 - (layout.place.y * uv.y + layout.place.w)
    columns = _beside(u, layout.width, layout)
    ends = dr.select(layout.wrap == _AROUND, _CLAMP, layout.wrap)
    rows = _beside(v, layout.height, layout._replace(wrap=ends))
    return [
        (layout.first + row * layout.width + column, across * along)
        for row, along in rows
        for column, across in columns
    ]


def _beside(place, count, layout: Layout) -> list[tuple[Any, Any]]:
    """Return the two texels that a place lies between, in one direction, and their shares."""
    # Texels are counted by their middles.
    place = place * mi.Float(count) - 0.5
    low = dr.floor(place)
    share = place - low
    share = dr.select(layout.nearest == 1, dr.select(share < 0.5, mi.Float(0), mi.Float(1)), share)
    return [(_wrapped(low, count, layout.wrap), 1 - share), (_wrapped(low + 1, count, layout.wrap), share)]


def _wrapped(place, count, wrap):
    width = mi.Float(count)
    again = place - width * dr.floor(place / width)
    there_and_back = place - 2 * width * dr.floor(place / (2 * width))
    mirrored = dr.minimum(there_and_back, 2 * width - 1 - there_and_back)
    found = dr.select(wrap == _MIRROR, mirrored, again)
    found = dr.select(wrap == _CLAMP, place, found)
    return mi.UInt32(dr.clip(found, 0, dr.maximum(width, 1) - 1))
