"""The wavelength bands of an image."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.floating]

# What a band's number stands for; see docs/units.md.
BandKind = Literal["averaged", "mean", "centre"]


# Of the kind ``mean``, each path sees one of so many equal parts of every band.
PARTS = 10


class Part(NamedTuple):
    """
    One of equal parts of every band: what a path sees of it, where products are to be averaged.

    Parameters
    ----------
    number : from 0
    count : parts of a band
    """

    number: int
    count: int


@dataclass(frozen=True, eq=False)
class Bands:
    """
    Adjacent wavelength bands.

    Parameters
    ----------
    centres : (bands,) array [nm]
        Strictly increasing.
    edges : (bands + 1,) array [nm]
        Band i reaches from edges[i] to edges[i + 1].
    """

    centres: FloatArray
    edges: FloatArray

    def __post_init__(self) -> None:
        if len(self.centres) == 0 or len(self.edges) != len(self.centres) + 1:
            raise ValueError(f"{len(self.edges)} edges for {len(self.centres)} bands, want one more")
        between = (self.edges[:-1] < self.centres) & (self.centres < self.edges[1:])
        if not between.all():
            raise ValueError("each band's centre must lie between its edges")

    def __len__(self) -> int:
        return len(self.centres)

    @property
    def widths(self) -> FloatArray:
        """(bands,) array [nm]"""
        return np.diff(self.edges)

    def part(self, part: Part) -> FloatArray:
        """Return (2, bands) lower and upper ends of one part of every band [nm]."""
        ends = np.array([part.number, part.number + 1]) / part.count
        return self.edges[:-1] + ends[:, None] * self.widths

    @classmethod
    def regular(cls, start: float, step: float, count: int) -> Bands:
        """
        Return equally wide bands, as RenderToolbox3's sampling ``[start step count]``.

        Parameters
        ----------
        start, step : first centre and band width [nm]
        """
        if count < 1 or step <= 0:
            raise ValueError(f"bands {start} {step} {count}: want a positive step and count")
        edges = start + step * (np.arange(count + 1) - 0.5)
        return cls(start + step * np.arange(count), edges)

    @classmethod
    def around(cls, centres: Sequence[float]) -> Bands:
        """Return bands that meet halfway between (at least two) given centres [nm]."""
        middle = np.asarray(centres, float)
        if len(middle) < 2:
            raise ValueError("a single centre has no width, give bands as start step count")
        inner = (middle[1:] + middle[:-1]) / 2
        ends = 2 * middle[[0, -1]] - inner[[0, -1]]
        return cls(middle, np.concatenate([ends[:1], inner, ends[1:]]))


DEFAULT_BANDS = Bands.regular(400, 10, 31)
