"""
What every kind of light can do: choose a direction towards it.

================  ==========================================  ==============================
kind              spectrum                                    sampled
================  ==========================================  ==============================
Triangles         radiance [W sr-1 m-2 nm-1]                  evenly over their area
Lamps             intensity [W sr-1 nm-1] of a mere point     the one direction
Spheres           intensity; radiance = intensity / (pi r^2)  evenly over the visible cone
Suns              irradiance E [W m-2 nm-1] across the light  the one direction, or a disc
                                                              of radiance E / (pi sin^2)
Skies             radiance [W sr-1 m-2 nm-1]                  where the picture is bright
================  ==========================================  ==============================

Densities are per solid angle [sr-1]: Veach, *Robust Monte Carlo Methods*, 1997, section 8.2.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from ....scene.render_scene import IntArray, Light
from ....spectra import FloatArray


class Sample(NamedTuple):
    """
    Directions from points to lights.

    Parameters
    ----------
    directions : (3, n) unit vectors
    reach : (n,) how far the way must be free [m]
    row : (n,) the light's row in Lights.spectra
    strength : (n,) what comes from there, times the spectrum: for an extended light radiance, for the
        others irradiance across the direction, so [1] or [m-2]
    density : (n,) [sr-1], or the mere chance of a light that has one direction only
    extended : (n,) 1.0 for lights that a scattered path may meet as well, else 0.0
    """

    directions: FloatArray
    reach: FloatArray
    row: IntArray
    strength: FloatArray
    density: FloatArray
    extended: FloatArray

    @classmethod
    def empty(cls, n: int) -> Sample:
        """Return room for n of them."""
        return cls(
            np.empty((3, n)), np.empty(n), np.empty(n, np.int32), np.empty(n), np.empty(n), np.empty(n)
        )

    def fill(self, rows: IntArray, part: Sample) -> None:
        """Put some of them in their places."""
        for whole, column in zip(self, part, strict=True):
            whole[..., rows] = column


class Group(Protocol):
    """
    Lights of one kind.

    Attributes
    ----------
    rows : (lights,) int array, rows of the table of spectra
    powers : (lights,) array, power per number in the spectrum [m2 sr or sr or m2]
    """

    rows: IntArray
    powers: FloatArray

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Return a direction from each of (3, n) points [m] to the light chosen for it."""
        ...


def number(light: Light, name: str, default: float) -> float:
    """Return a number of a light."""
    return float(light.parameters.get(name, default))  # type: ignore[arg-type]
