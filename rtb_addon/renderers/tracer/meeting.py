"""
Where paths meet surfaces of one kind of material, and what such a kind can do.

Directions do not depend on wavelength; what depends on it comes out as a column per band. So the spectra of
a scene never decide where a path goes, but for glass that disperses and for what is fluorescent: there a path
may be left to one of its bands.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray
from .directions import Frame
from .intersect import Places

if TYPE_CHECKING:
    pass


@dataclass(frozen=True, eq=False)
class Meeting:
    """
    Paths and the surfaces of one kind that they met.

    Parameters
    ----------
    row : (n,) int array, each surface's row among the materials of its kind
    places : where that was
    directions : (3, n) unit vectors along which the paths came
    band : (n,) int array, the paths' Paths.band; None where all paths are of all bands
    under : the same as the material under a relief sees it, None where there is no relief
    """

    row: IntArray
    places: Places
    directions: FloatArray
    band: IntArray | None = None
    under: Meeting | None = None

    @cached_property
    def frame(self) -> Frame:
        """Each place's own axes; the third is the normal on the side that the path came from."""
        return Frame.about(self.places.normals.astype(float), self.places.tangents)

    @cached_property
    def back(self) -> FloatArray:
        """The (3, n) unit vectors back to where the paths came from, along the axes of frame."""
        return -self.frame.local(self.directions)

    def only(self, rows: IntArray) -> Meeting:
        """Return some of them, in this order."""
        if len(rows) == len(self.row):
            return self
        band = None if self.band is None else self.band.take(rows)
        return Meeting(self.row[rows], self.places.only(rows), self.directions.take(rows, axis=1), band)


class Onward(NamedTuple):
    """
    Where paths go on.

    Parameters
    ----------
    directions : (3, n) unit vectors
    density : (n,) of the direction [sr-1]; infinite where it was the only one, 0 where the path ends
    weight : (n, bands or 1) array, f cos / density, without what Model.shared says; None where that is 1
    band : (n,) int array, the Paths.band of what goes on; None where it is as it was
    """

    directions: FloatArray
    density: FloatArray
    weight: FloatArray | None = None
    band: IntArray | None = None


class Model(ABC):
    """
    A kind of material: all materials of a scene that scatter by the same formulas.

    Attributes
    ----------
    single : it scatters into single directions only, so that looking for a light is in vain
    transmits : light goes through
    parts : it may leave a path to one of its bands, see Paths.band
    """

    single = False
    transmits = False
    parts = False

    def meeting(self, met: Meeting) -> Meeting:
        """Return a meeting as the other methods want it."""
        return met

    def shared(self, met: Meeting) -> FloatArray | None:
        """Return the (n, bands) factor of all that a surface scatters, None where there is none."""
        return None

    @abstractmethod
    def evaluate(self, met: Meeting, rows: IntArray, towards: FloatArray) -> tuple[FloatArray, FloatArray]:
        """
        Return f cos and the density [sr-1] of scattered() at some of the places.

        f cos is (m, bands or 1), without what shared() says.

        Parameters
        ----------
        rows : (m,) int array, which places
        towards : (3, n) unit vectors, one from every place
        """

    def turned(self, met: Meeting, rows: IntArray, light: FloatArray) -> FloatArray:
        """Return the (m, bands) light that leaves some of the places for what came in."""
        return light

    @abstractmethod
    def scattered(self, met: Meeting, u: FloatArray, v: FloatArray) -> Onward:
        """Return a direction from each place for (n,) random numbers in [0, 1)."""


def chosen(chance: FloatArray, u: FloatArray) -> tuple[NDArray[np.bool_], FloatArray]:
    """Return which of (n,) random numbers in [0, 1) are below a chance, and numbers as random as before."""
    first = u < chance
    rest = np.where(first, u, u - chance) / np.maximum(np.where(first, chance, 1 - chance), 1e-30)
    return first, rest.clip(0, 1 - 2.0**-53)


def weighed(value: FloatArray, density: FloatArray) -> FloatArray:
    """Return values over their densities [sr-1], 0 where the density is."""
    return value * column(np.where(density > 0, 1 / np.where(density > 0, density, 1), 0))


def column(values: FloatArray) -> FloatArray:
    """Return (n,) numbers as an (n, 1) float32 array, the same for every band."""
    return values.astype(np.float32)[:, None]
