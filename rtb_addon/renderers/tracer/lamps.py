"""
The kinds of light, each with its own way to choose a direction towards it.

================  ==========================================  ==============================
kind              spectrum                                    sampled
================  ==========================================  ==============================
Triangles         radiance [W sr-1 m-2 nm-1]                  evenly over their area
Lamps             intensity [W sr-1 nm-1] of a mere point     the one direction
Spheres           intensity; radiance = intensity / (pi r^2)  evenly over the visible cone
Suns              irradiance E [W m-2 nm-1] across the light  the one direction, or a disc
                                                              of radiance E / (pi sin^2)
================  ==========================================  ==============================

Densities are per solid angle [sr-1]: Veach, *Robust Monte Carlo Methods*, 1997, section 8.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray, Light
from ...spectra import FloatArray
from .directions import cone, cross, dot, length, normalised
from .intersect import Surfaces
from .kernels import Hits

# A shadow ray ends this part of its length before a lamp, so that the lamp's own sphere is not in its way.
_SHORT = 1 - 1e-6


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


class Triangles:
    """Emitting triangles; they shine to the side of their normals."""

    def __init__(self, surfaces: Surfaces, row_of: NDArray[np.int32]) -> None:
        shining = np.nonzero(row_of >= 0)[0]
        corner, second, third = surfaces.corners[:, :, shining]
        one, two = second - corner, third - corner
        area = length(cross(one, two)) / 2
        kept = area > 0
        self.triangle, self.area = shining[kept], area[kept]
        self.rows, self.powers = row_of[self.triangle], np.pi * self.area
        normals, lift = surfaces.normals[:, shining], surfaces.lift[shining]
        table = np.concatenate([corner, one, two, normals, area[None], lift[None]])[:, kept]
        self._table = table.astype(np.float32)

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Sample evenly over the area: Turk 1990, *Generating Random Points in Triangles*, method 2."""
        root = np.sqrt(1 - u)
        first, second = (1 - root).astype(np.float32), (v * root).astype(np.float32)
        table = self._table.take(which, axis=1)
        way = table[0:3] + first * table[3:6] + second * table[6:9] - points
        distance = np.maximum(length(way), np.float32(1e-30))
        way /= distance
        cosine = -dot(table[9:12], way)
        shines = cosine > 0
        cosine = np.maximum(cosine, np.float32(1e-12))
        density = distance**2 / (cosine * table[12])
        # As rays start a little above a surface, they end a little above this one.
        reach = np.maximum(distance - table[13] / cosine, 0)
        ones = np.ones(len(u), np.float32)
        return Sample(way, reach, self.rows.take(which), shines * ones, density, ones)


class _Beams:
    """What point and spot lights share: places, axes, and Blender's spot profile."""

    def __init__(self, lights: Sequence[Light], first: int) -> None:
        self.rows = first + np.arange(len(lights))
        self.places = np.array([light.to_world[:3, 3] for light in lights], float).reshape(-1, 3).T
        axes = np.array([-light.to_world[:3, 2] for light in lights], float).reshape(-1, 3).T
        self._axes = normalised(axes)
        # A point light is a spot whose cone is wider than everything.
        halves = np.radians(np.array([_number(light, "cone", 360.0) for light in lights], float)) / 2
        spots = np.array([light.kind == "spot" for light in lights], bool)
        self._edge = np.where(spots, np.cos(halves), -2.0)
        soft = np.array([_number(light, "blend", 0.0) for light in lights], float)
        self._soft = np.maximum((1 - self._edge) * np.where(spots, soft, 0), 1e-12)
        self.powers = 2 * np.pi * (1 - np.maximum(self._edge, -1))

    def profile(self, which: IntArray, away: FloatArray) -> FloatArray:
        """
        Return the part of the axial intensity that leaves in unit directions away from the light.

        Blender's: with t = (cos a - cos h) / ((1 - cos h) blend), clamped, t^2 (3 - 2t); a is the
        angle from the axis and h half the cone.
        """
        cosines = dot(self._axes[:, which], away)
        t = ((cosines - self._edge[which]) / self._soft[which]).clip(0, 1)
        return t * t * (3 - 2 * t)


class Lamps(_Beams):
    """Point and spot lights that are mere points: irradiance I / d^2 across the direction."""

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Return the one direction there is."""
        way = self.places[:, which] - points
        distance = np.maximum(length(way), 1e-30)
        way /= distance
        strength = self.profile(which, -way) / distance**2
        none = np.zeros(len(u))
        return Sample(way, distance * _SHORT, self.rows[which], strength, none + 1, none)


class Spheres(_Beams):
    """
    Point and spot lights with a radius: black spheres that shine outwards.

    Every point of the sphere has the same radiance in the same direction, I(direction) / (pi r^2), so
    that seen from far the intensity is I and outside the sphere E = I / d^2 holds exactly.
    """

    def __init__(self, lights: Sequence[Light], first: int) -> None:
        super().__init__(lights, first)
        self.radii = np.array([_number(light, "radius", 0.0) for light in lights], float)

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Sample evenly over the cone that the sphere fills; from inside nothing is seen."""
        way = self.places[:, which] - points
        distance, radius = length(way), self.radii[which]
        outside = distance > radius
        axes = np.where(outside, way / np.maximum(distance, 1e-30), [[0.0], [0.0], [1.0]])
        directions = cone(axes, self._one_minus_cosine(which, distance), u, v)
        along = dot(directions, way)
        reach = along - np.sqrt(np.maximum(radius**2 - distance**2 + along**2, 0))
        density = self.density(which, points)
        strength = outside * self.radiance(which, directions)
        row, ones = self.rows[which], np.ones(len(u))
        return Sample(directions, np.maximum(reach * _SHORT, 0), row, strength, density, ones)

    def density(self, which: IntArray, points: FloatArray) -> FloatArray:
        """Return the density [sr-1] of directions from points; 1 inside, where none is used."""
        distance = length(self.places[:, which] - points)
        return 1 / (2 * np.pi * self._one_minus_cosine(which, distance))

    def radiance(self, which: IntArray, directions: FloatArray) -> FloatArray:
        """Return the radiance [m-2, times the intensity] met along directions towards a sphere."""
        return self.profile(which, -directions) / (np.pi * self.radii[which] ** 2)

    def before(self, hits: Hits, origins: FloatArray, directions: FloatArray) -> Hits:
        """Return what rays meet when the spheres are there too."""
        triangle, distance = hits.triangle, hits.distance
        for sphere in range(len(self.rows)):
            away = self._distance(sphere, origins, directions)
            nearer = away < distance
            triangle, distance = np.where(nearer, -2 - sphere, triangle), np.where(nearer, away, distance)
        return hits._replace(triangle=triangle, distance=distance)

    def block(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays meet a sphere before their reach."""
        blocked = np.zeros(len(reach), bool)
        for sphere in range(len(self.rows)):
            blocked |= self._distance(sphere, origins, directions) < reach
        return blocked

    def _distance(self, sphere: int, origins: FloatArray, directions: FloatArray) -> FloatArray:
        """Return how far along rays a sphere's outside begins [m]; infinite where it is missed."""
        way = self.places[:, sphere, None] - origins
        along = dot(directions, way)
        # How far the ray passes the centre, from a difference of vectors: no digits are lost.
        beside = way - along * directions
        depth = self.radii[sphere] ** 2 - dot(beside, beside)
        distance = along - np.sqrt(np.maximum(depth, 0))
        return np.where((depth > 0) & (distance > 0), distance, np.inf)

    def _one_minus_cosine(self, which: IntArray, distance: FloatArray) -> FloatArray:
        """Return 1 - cos of half the angle that a sphere fills, without losing small angles."""
        sine2 = (self.radii[which] / np.maximum(distance, 1e-30)) ** 2
        return np.where(sine2 < 1, sine2 / (1 + np.sqrt(np.maximum(1 - sine2, 0))), 1 / (2 * np.pi))


class Suns:
    """Directional lights, as a single direction or as a disc in the sky."""

    def __init__(self, lights: Sequence[Light], first: int, radius: float) -> None:
        self.rows = first + np.arange(len(lights))
        self.powers = np.full(len(lights), np.pi * radius**2)
        axes = np.array([light.to_world[:3, 2] for light in lights], float).reshape(-1, 3).T
        self.towards = normalised(axes)
        half = np.radians(np.array([_number(light, "angle", 0.0) for light in lights], float)) / 2
        self.one_minus_cosine: FloatArray = 2 * np.sin(half / 2) ** 2
        self.extended = half > 0
        self.densities = 1 / np.where(self.extended, 2 * np.pi * self.one_minus_cosine, 1)
        self.radiance = 1 / np.where(self.extended, np.pi * np.sin(half) ** 2, 1)

    def sample(self, which: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Sample evenly over the disc."""
        directions = cone(self.towards[:, which], self.one_minus_cosine[which], u, v)
        reach = np.full(len(u), 1e30)
        strength, density = self.radiance[which], self.densities[which]
        return Sample(directions, reach, self.rows[which], strength, density, self.extended[which] * 1.0)

    def seen(self, sun: int, directions: FloatArray) -> NDArray[np.bool_]:
        """Return which directions point into a sun's disc."""
        apart = directions - self.towards[:, sun, None]
        return self.extended[sun] & (dot(apart, apart) < 2 * self.one_minus_cosine[sun])


def _number(light: Light, name: str, default: float) -> float:
    return float(light.parameters.get(name, default))  # type: ignore[arg-type]
