"""Point and spot lights: mere points, and balls that shine."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ....scene.render_scene import IntArray, Light
from ....spectra import FloatArray
from ..directions import cone, dot, length, normalised
from ..kernels import Hits
from .groups import Sample, number

# A shadow ray ends this part of its length before a lamp, so that the lamp's own sphere is not in its way.
_SHORT = 1 - 1e-6


class _Beams:
    """What point and spot lights share: places, axes, and Blender's spot profile."""

    def __init__(self, lights: Sequence[Light], first: int) -> None:
        self.rows = first + np.arange(len(lights))
        self.places = np.array([light.to_world[:3, 3] for light in lights], float).reshape(-1, 3).T
        axes = np.array([-light.to_world[:3, 2] for light in lights], float).reshape(-1, 3).T
        self._axes = normalised(axes)
        # A point light is a spot whose cone is wider than everything.
        halves = np.radians(np.array([number(light, "cone", 360.0) for light in lights], float)) / 2
        spots = np.array([light.kind == "spot" for light in lights], bool)
        self._edge = np.where(spots, np.cos(halves), -2.0)
        soft = np.array([number(light, "blend", 0.0) for light in lights], float)
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
        self.radii = np.array([number(light, "radius", 0.0) for light in lights], float)

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
