"""
Where light comes from: every light of a scene in one table, chosen by power and sampled by its shape.

A light's spectrum, one row of Lights.spectra, is apart from where and how strongly it shines,
so that paths do not depend on it but for how often each light is chosen. A picture of the sky
multiplies that row, direction by direction; one without colours changes the strength alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ....scene.render_scene import IntArray, Light, RenderScene
from ....spectra import FloatArray
from ..directions import dot
from ..intersect import Surfaces
from ..kernels import Hits
from ..tables import table
from .groups import Group, Sample
from .lamps import Lamps, Spheres
from .sky import Skies
from .suns import Suns
from .triangles import Triangles

# So many lights, or triangles of them, are told apart sooner one by one than by bisection.
_FEW = 16


class Met(NamedTuple):
    """
    A light that some rays meet.

    Parameters
    ----------
    rows : (m,) int array, which rays
    row : (m,) int array, the light's row in Lights.spectra
    strength : (m,) radiance, times that spectrum
    rival : density [sr-1] with which Lights.sample would have chosen this direction
    """

    rows: IntArray
    row: IntArray
    strength: FloatArray
    rival: FloatArray | float


class Lights:
    """
    Everything that shines in a scene.

    Attributes
    ----------
    spectra : (rows, bands) float32 array, in the unit of each kind of light; the environment's is last
    spheres : lights that are solid
    plain : whether the spectrum of each light is the same in all directions
    """

    def __init__(self, scene: RenderScene, surfaces: Surfaces) -> None:
        emitting = [number for number, shape in enumerate(scene.shapes) if shape.emission is not None]
        row_of_shape = np.full(len(scene.shapes) + 1, -1, np.int32)
        row_of_shape[emitting] = np.arange(len(emitting))
        self._row_of, self._normals = row_of_shape[surfaces.shape], surfaces.normals
        lamps, spheres, suns = sorted_out(scene)
        count = len(emitting)
        self._triangles = Triangles(surfaces, self._row_of)
        self._row_of = np.pad(self._row_of, (0, 1 + len(spheres)), constant_values=-1)
        self._lamps = Lamps(lamps, count)
        self._spheres = self.spheres = Spheres(spheres, count + len(lamps))
        self._suns = Suns(suns, count + len(lamps) + len(spheres), surfaces.radius())
        self.spectra = _spectra(scene, [*lamps, *spheres, *suns])
        self._skies = Skies(scene.environment, scene.film, len(self.spectra) - 1, surfaces.radius())
        groups = self._triangles, self._lamps, self._spheres, self._suns, self._skies
        self._groups: tuple[Group, ...] = groups
        self._environment = scene.environment is not None
        self.plain = not len(self._skies.rows) or self._skies.grey is not None
        if self._skies.grey is not None:
            self.spectra[-1] *= self._skies.grey
        self._choose()

    def sample(self, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample | None:
        """
        Choose a light for each of (3, n) points [m] and a direction to it; None where nothing can be chosen.

        Parameters
        ----------
        u, v : (n,) arrays in [0, 1)
        """
        if not len(self._chance):
            return None
        element, u = self._chosen(u)
        sample = self._sample(element, points, u, v)
        return sample._replace(density=sample.density * self._chance.take(element))

    def _chosen(self, u: FloatArray) -> tuple[IntArray, FloatArray]:
        """Return which element of which light each of (n,) numbers chooses, and numbers as random again."""
        if len(self._chance) > _FEW:
            element = np.searchsorted(self._sums[1:-1], u, side="right")
        else:
            element = np.zeros(len(u), int)
            for edge in self._sums[1:-1]:
                element += u >= edge
        u = (u - self._sums.take(element)) / self._chance.take(element)
        return element, np.minimum(np.maximum(u, 0), 1 - 2.0**-53)

    def _sample(self, element: IntArray, points: FloatArray, u: FloatArray, v: FloatArray) -> Sample:
        """Return a direction to each point's light, from the group that knows it."""
        present = [one for one in zip(self._first, self._groups, strict=True) if len(one[1].rows)]
        if len(present) == 1:
            return present[0][1].sample(element, points, u, v)
        sample = Sample.empty(len(u))
        for first, group in present:
            rows = np.nonzero((element >= first) & (element < first + len(group.rows)))[0]
            theirs = points.take(rows, axis=1)
            sample.fill(rows, group.sample(element[rows] - first, theirs, u[rows], v[rows]))
        return sample

    def coming(self, row: IntArray, directions: FloatArray) -> FloatArray:
        """Return the (n, bands) spectra of lights by row, as they come along (3, n) unit directions."""
        light = self.spectra.take(row, axis=0)
        if len(self._skies.rows) and self._skies.grey is None:
            sky = np.nonzero(row == len(self.spectra) - 1)[0]
            light[sky] *= self._skies.radiance(directions.take(sky, axis=1))
        return light

    def met(self, hits: Hits, origins: FloatArray, directions: FloatArray) -> Iterator[Met]:
        """Yield the lights that rays meet, (3, n) origins [m] and unit directions."""
        yield self._met_triangles(hits, directions)
        for sphere in range(len(self._spheres.rows)):
            yield self._met_sphere(sphere, np.nonzero(hits.triangle == -2 - sphere)[0], origins, directions)
        escaped = np.nonzero(hits.triangle == -1)[0]
        for sun in range(len(self._suns.rows)):
            yield self._met_sun(sun, escaped[self._suns.seen(sun, directions.take(escaped, axis=1))])
        if self._environment:
            yield self._met_environment(escaped, directions)

    def _met_triangles(self, hits: Hits, directions: FloatArray) -> Met:
        # What is no triangle is negative, and finds the -1 at the end of the table.
        rows = np.nonzero(self._row_of.take(hits.triangle) >= 0)[0]
        triangle = hits.triangle[rows]
        cosine = -dot(self._normals[:, triangle], directions[:, rows])
        rows, triangle, cosine = rows[cosine > 0], triangle[cosine > 0], cosine[cosine > 0]
        rival = self._per_area[triangle] * np.asarray(hits.distance[rows], float) ** 2 / cosine
        return Met(rows, self._row_of[triangle], np.ones(len(rows)), rival)

    def _met_sphere(self, sphere: int, rows: IntArray, origins: FloatArray, directions: FloatArray) -> Met:
        which = np.full(len(rows), sphere)
        chance = self._chance[self._first[2] + sphere]
        rival = chance * self._spheres.density(which, origins[:, rows])
        return Met(rows, self._spheres.rows[which], self._spheres.radiance(which, directions[:, rows]), rival)

    def _met_sun(self, sun: int, rows: IntArray) -> Met:
        rival = float(self._chance[self._first[3] + sun] * self._suns.densities[sun])
        row, radiance = self._suns.rows[sun], self._suns.radiance[sun]
        return Met(rows, np.full(len(rows), row), np.full(len(rows), radiance), rival)

    def _met_environment(self, rows: IntArray, directions: FloatArray) -> Met:
        # Scattering samples an even environment as well as anything could, so nothing rivals it.
        rival: FloatArray | float = 0.0
        strength: FloatArray = np.ones(len(rows), np.float32)
        if len(self._skies.rows):
            strength, density = self._skies.seen(directions.take(rows, axis=1))
            rival = self._chance[-1] * density
        return Met(rows, np.full(len(rows), len(self.spectra) - 1), strength, rival)

    def _choose(self) -> None:
        """
        Fix how often each light is chosen: half the choices by power, half evenly among the lights.

        By power alone, the sun over a wide plain would leave nothing for the lamp in a room. Within
        a light, its triangles are chosen by area.
        """
        rows = np.concatenate([group.rows for group in self._groups])
        area = np.concatenate([group.powers for group in self._groups])
        power = area * self.spectra.mean(axis=1, dtype=float)[rows]
        whole = np.bincount(rows, area, len(self.spectra))[rows]
        even = area / np.where(whole > 0, whole, 1) / max(len(np.unique(rows)), 1)
        chance = even + (power / power.sum() if power.sum() > 0 else even)
        self._chance = chance / chance.sum() if len(rows) else chance
        self._sums = np.concatenate([[0.0], np.cumsum(self._chance)])
        self._first = np.cumsum([0, *(len(group.rows) for group in self._groups[:-1])])
        self._per_area = np.zeros(len(self._row_of))
        ours = self._chance[: len(self._triangles.rows)]
        self._per_area[self._triangles.triangle] = ours / self._triangles.area


def sorted_out(scene: RenderScene) -> tuple[list[Light], list[Light], list[Light]]:
    """Return the lights that are points, those that are spheres, and suns."""
    suns = [light for light in scene.lights if light.kind == "directional"]
    beams = [light for light in scene.lights if light.kind != "directional"]
    points = [light for light in beams if not light.parameters.get("radius")]
    return points, [light for light in beams if light.parameters.get("radius")], suns


def _spectra(scene: RenderScene, lights: Sequence[Light]) -> FloatArray:
    """Return the (rows, bands) spectra of emitting shapes, of lights and, last, of the environment."""
    named = [(f"shape {shape.id}", shape.emission) for shape in scene.shapes if shape.emission is not None]
    named += [(f"light {light.id}", light.parameters["intensity"]) for light in lights]
    named.append(("the environment", scene.environment.parameters["intensity"] if scene.environment else 0.0))
    return table(named, scene.film)
