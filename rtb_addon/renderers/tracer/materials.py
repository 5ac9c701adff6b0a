"""
How surfaces scatter light.

Matte is all there is: f = reflectance / pi on both sides. What depends on wavelength, the reflectance,
is kept apart from what depends on directions: paths multiply their bands by the one and
sample by the other, so the spectra of a scene never decide where a path goes.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ...scene.render_scene import Film, Material
from ...spectra import FloatArray
from .directions import normalised, sphere
from .tables import table


class Materials:
    """
    The materials of a scene by number.

    Attributes
    ----------
    numbers : id -> number
    reflectance : (materials, bands) float32 array
    reflects : (materials,) bool array, False for those that are black in every band
    """

    def __init__(self, materials: Iterable[Material], film: Film) -> None:
        materials = list(materials)
        self.numbers = {material.id: number for number, material in enumerate(materials)}
        named = [(f"material {one.id}", one.parameters["diffuseReflectance"]) for one in materials]
        self.reflectance = table(named, film)
        self.reflects = self.reflectance.any(axis=1)


def lobe(cosines: FloatArray) -> FloatArray:
    """
    Return f cos / reflectance [sr-1] of a matte surface: max(cos, 0) / pi.

    It is also the density [sr-1] of scattered(), whose weight is thus the reflectance itself.
    """
    return np.maximum(cosines, 0) / np.pi


def scattered(normals: FloatArray, u: FloatArray, v: FloatArray) -> FloatArray:
    """
    Return directions with density cos / pi about unit normals.

    An even point of the unit sphere that the surface touches from below, seen from the
    surface, is so distributed (Malley's method without the disc).
    """
    return normalised(normals + sphere(u, v))
