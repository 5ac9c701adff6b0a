"""
Spectra in the device's memory: a row each, fetched four numbers at a time.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi

from .arrays import floats

# Numbers that memory gives at once.
PACKET = 4


def padded(bands: int) -> int:
    """Return a number of bands, rounded up to whole packets."""
    return -bands % PACKET + bands


def fetch(table, row, packets: int, active=True) -> list:
    """Return the numbers of a row of so many packets, one mi.Float each."""
    found: list[Any] = [dr.gather(mi.Vector4f, table, row * packets + k, active) for k in range(packets)]
    return [packet[k] for packet in found for k in range(PACKET)]


class Rows:
    """
    Spectra by row.

    Parameters
    ----------
    values : (..., parts, padded bands) numbers; all axes before the last two count rows, perhaps none
    parts, bands : lengths of the last two axes
    """

    def __init__(self, values, parts: int, bands: int) -> None:
        self._parts, self._packets = parts, bands // PACKET
        self._numbers = floats(values)

    def at(self, row, part, active) -> list:
        """Return spectra, one mi.Float a band; in a part of each band where bands have parts."""
        if part is not None:
            row = row * self._parts + part
        return fetch(self._numbers, row, self._packets, active)
