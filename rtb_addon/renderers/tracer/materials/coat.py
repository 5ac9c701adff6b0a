"""What rough clear coats let through, tabled per material as Mitsuba 3 does."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ....scene.render_scene import IntArray
from ....spectra import FloatArray
from . import fresnel
from .facets import Slopes

# Angles of the tables, evenly spaced cosines; and how finely each is integrated over the small mirrors.
_ANGLES, _STEPS = 64, 64


class Coats:
    """
    Rough clear coats.

    Parameters
    ----------
    eta : (materials,) index inside per index outside
    roughness : (materials,) of its slopes

    Attributes
    ----------
    inside : (materials,) share that a coat reflects of diffuse light from inside
    """

    def __init__(self, eta: FloatArray, roughness: FloatArray, slopes: Slopes) -> None:
        tables = [_table(*pair, slopes) for pair in zip(eta.tolist(), roughness.tolist(), strict=True)]
        self._through = np.array([through for through, _ in tables])
        self.inside = np.array([inside for _, inside in tables])

    def transmitted(self, row: IntArray, cosine: FloatArray) -> FloatArray:
        """Return the share that comes in from directions with (n,) cosines to the normal."""
        place = cosine.clip(0, 1) * (_ANGLES - 1)
        low = np.minimum(place.astype(int), _ANGLES - 2)
        part = place - low
        return self._through[row, low] * (1 - part) + self._through[row, low + 1] * part


@lru_cache(maxsize=64)
def _table(eta: float, roughness: float, slopes: Slopes) -> tuple[FloatArray, float]:
    """Return what comes in at all angles, and what is reflected inside; conditions have that in common."""
    cosines = np.linspace(1e-6, 1, _ANGLES)
    # The mean over the table, as Mitsuba 3 takes it; the integral itself is one or two per cent more.
    inside = 2 * np.mean(cosines * reflected(cosines, 1 / eta, roughness, slopes))
    return transmitted(cosines, eta, roughness, slopes), float(inside)


def reflected(cosines: FloatArray, eta: float, roughness: float, slopes: Slopes) -> FloatArray:
    """Return the share that a rough clear surface reflects once, met under (n,) cosines."""
    return _shares(cosines, eta, roughness, slopes)[:, 0]


def transmitted(cosines: FloatArray, eta: float, roughness: float, slopes: Slopes) -> FloatArray:
    """Return the share that goes through at once; what is missing to 1 would be scattered more than once."""
    return _shares(cosines, eta, roughness, slopes)[:, 1]


def _shares(cosines: FloatArray, eta: float, roughness: float, slopes: Slopes) -> FloatArray:
    """Return (n, 2) shares, reflected and transmitted; eta is the index behind per index before."""
    nodes, weights = np.polynomial.legendre.leggauss(_STEPS)
    u, v = np.meshgrid((nodes + 1) / 2, (np.arange(_STEPS) + 0.5) / _STEPS, indexing="ij")
    share = np.repeat(weights / 2 / _STEPS, _STEPS)
    way = u.ravel(), v.ravel(), np.full(u.size, roughness)
    return np.array([_from(cosine, eta, way, share, slopes) for cosine in cosines])


def _from(
    cosine: float, eta: float, way: tuple[FloatArray, ...], share: FloatArray, slopes: Slopes
) -> FloatArray:
    """Return both shares for one direction: means of F G and (1 - F) G over the mirrors in sight."""
    u, v, alpha = way
    back = np.array([np.sqrt(1 - cosine**2), 0, cosine])[:, None].repeat(len(u), axis=1)
    h = slopes.facets(back, u, v, alpha, alpha)
    met = (back * h).sum(axis=0)
    reflectance, behind = fresnel.dielectric(met.clip(0, 1), np.full(len(met), eta))
    there = 2 * met * h - back
    through = (met / eta - behind) * h - back / eta
    seen = share * np.maximum(met, 0) * slopes.distribution(h, alpha, alpha)
    seen /= slopes.density(back, h, alpha, alpha)
    reflected = reflectance * slopes.unmasked(there, alpha) * (there[2] > 0)
    transmitted = (1 - reflectance) * slopes.unmasked(through, alpha) * (through[2] < 0)
    return np.array([seen @ reflected, seen @ transmitted]) / seen.sum()
