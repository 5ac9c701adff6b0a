"""
From the camera to the light: a path tracer over many paths at once.

Paths leave the camera in waves. At every surface that they meet they look for a light (next-event
estimation), then go on in a random direction, where they may find a light as well; both ways together are
weighed by the balance heuristic (Veach and Guibas, *Optimally Combining Sampling Techniques*, 1995).
A path's length is its integrator's depth; from the depth called roulette it may end before, by chance. What
its light is multiplied by in every band on the way is a Carrier's to know (carried.py).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray, Integrator, RenderScene
from ...spectra import FloatArray
from .carried import Carrier, InBands, Light
from .directions import dot, length
from .histories import Histories, InHistories
from .intersect import Surfaces, warm_surfaces
from .kernels import Hits, Kernel
from .lights import Lights
from .lights.groups import Sample
from .materials import Materials
from .meeting import Meeting, Model
from .paths import Paths
from .sampler import Sampler

# How often paths go on where they may end: whatever their spectra, so that those may be changed afterwards.
_GO_ON = 0.75
# What a path needs random numbers for: at the camera, which is step 0, and at every step after it.
FILM, LENS = range(2)
LIGHT, ONWARD, PART, ROULETTE = range(4)
_USES = 4

Pair = tuple[FloatArray, FloatArray]


class Draw(NamedTuple):
    """
    The random numbers of a wave.

    Parameters
    ----------
    pixel, sample : (n,) int arrays, each path's place among those of the sampler
    """

    sampler: Sampler
    pixel: IntArray
    sample: IntArray

    def pair(self, step: int, use: int, number: IntArray) -> Pair:
        """Return two (n,) arrays in [0, 1) for a use of some paths at a step, 0 being the camera."""
        return self.sampler.pair(step * _USES + use, self.pixel.take(number), self.sample.take(number))


def pairs_needed(integrator: Integrator) -> int:
    """Return how many pairs of random numbers a path may ask for."""
    return depth_of(integrator) * _USES


class World(NamedTuple):
    """A scene, ready to be met by rays; it stands around zero."""

    surfaces: Surfaces
    materials: Materials
    lights: Lights
    histories: Histories | None

    @classmethod
    def of(cls, scene: RenderScene, kernel: Callable[[FloatArray], Kernel]) -> World:
        """Return the world of a scene around zero, its rays found by a kernel."""
        materials = Materials(scene.materials, scene.film, scene.textures)
        asked = materials.oriented, materials.textured
        surfaces = warm_surfaces(scene.shapes, materials.numbers, kernel, *asked)
        histories = Histories(materials.plain.spectra) if materials.plain else None
        return cls(surfaces, materials, Lights(scene, surfaces), histories)

    def carrier(self, pixels: int) -> Carrier:
        """Return what follows the spectra along the paths of so many pixels."""
        plain, histories = self.materials.plain, self.histories
        if plain is None or histories is None or not self.lights.plain:
            return InBands(self.lights, pixels)
        return InHistories(self.lights, pixels, plain, histories)

    def meet(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits:
        """Return what rays meet first, triangles or lights that are solid."""
        return self.lights.spheres.before(self.surfaces.meet(origins, directions, reach), origins, directions)

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays meet anything before their reach."""
        way = origins, directions, reach
        return self.surfaces.blocked(*way) | self.lights.spheres.block(*way)


def follow(world: World, paths: Paths, draw: Draw, integrator: Integrator, carrier: Carrier) -> None:
    """Follow paths to the end; the carrier takes the light that they find."""
    depth = depth_of(integrator)
    for step in range(1, depth + 1):
        hits = world.meet(paths.origins, paths.directions, paths.reach)
        _bring_met(world, paths, hits, carrier)
        if step == depth:
            break
        meetings = met_surfaces(world, paths, hits, draw, step, carrier)
        # What is not needed any more makes room in the processor's cache.
        del paths, hits
        paths = _gone_on(world, meetings, draw, step, carrier)
        if integrator.roulette and step + 1 >= integrator.roulette:
            paths = paths.only(np.nonzero(draw.pair(step, ROULETTE, paths.number)[0] < _GO_ON)[0])
            carrier.gain /= _GO_ON
        if not len(paths.number):
            break
    carrier.end()


def depth_of(integrator: Integrator) -> int:
    """Return the length of the longest paths; direct light is a path of two."""
    return min(integrator.depth, 2) if integrator.kind == "direct" else integrator.depth


def _bring_met(world: World, paths: Paths, hits: Hits, carrier: Carrier) -> None:
    """
    Bring the lights that paths met by themselves.

    The balance heuristic: scattering chose this direction with one density, looking for a light
    would have with a rival one, so it counts for density / (density + rival).
    """
    for rows, row, strength, rival in world.lights.met(hits, paths.origins, paths.directions):
        if len(rows):
            strength = strength / (1 + rival / paths.density.take(rows))
            light = Light(rows, row, paths.directions.take(rows, axis=1), strength[:, None])
            carrier.bring(paths, light)


def _gone_on(
    world: World, meetings: list[tuple[Model, Paths, Meeting]], draw: Draw, step: int, carrier: Carrier
) -> Paths:
    """Look for lights from where paths met surfaces, and return the paths that go on."""
    parts = []
    while meetings:
        model, paths, met = meetings.pop()
        _bring_sampled(world, paths, model, met, draw.pair(step, LIGHT, paths.number), carrier)
        parts.append(scattered(paths, model, met, draw.pair(step, ONWARD, paths.number), carrier))
    return Paths.joined(parts)


def met_surfaces(
    world: World, paths: Paths, hits: Hits, draw: Draw, step: int, carrier: Carrier
) -> list[tuple[Model, Paths, Meeting]]:
    """
    Return the paths that met a surface which is not black, by how it scatters, and what they met.

    What is made of several materials is one of them, by chance.
    """
    rows = np.nonzero(hits.triangle >= 0)[0]
    material = world.surfaces.material.take(hits.triangle.take(rows))
    if world.materials.mixtures is not None:
        number = draw.pair(step, PART, paths.number.take(rows))[0]
        material = world.materials.mixtures.one_of(material, number)
    bright = np.nonzero(world.materials.reflects.take(material))[0]
    rows, material = rows.take(bright), material.take(bright)
    meetings = []
    for model, where, row in world.materials.sorted(material):
        theirs, some = paths.only(rows[where]), hits.only(rows[where])
        places = world.surfaces.places(some, theirs.directions)
        met = model.meeting(Meeting(row, places, theirs.directions, theirs.band))
        # In place even where nothing was left out: nobody asks for the paths as they came.
        meetings.append((model, theirs._replace(carried=carrier.met(theirs, model, met)), met))
    return meetings


def _bring_sampled(
    world: World, paths: Paths, model: Model, met: Meeting, draw: Pair, carrier: Carrier
) -> None:
    """
    Look for a light from every place, and bring it where the way is free.

    f cos / density, times the balance heuristic density / (density + rival) where scattering could have
    met the light as well; the rival density is that of scattering.
    """
    sample = None if model.single else world.lights.sample(met.places.start, *draw)
    if sample is None:
        return
    side = dot(met.places.faces, sample.directions)
    rows = np.nonzero((sample.strength > 0) & ((side > 0) | model.transmits))[0]
    rows = rows[~world.blocked(*_ways(met, model, sample, side, rows))]
    value, rival = model.evaluate(met, rows, sample.directions)
    strength = sample.strength.take(rows) / (sample.density.take(rows) + sample.extended.take(rows) * rival)
    directions = sample.directions.take(rows, axis=1)
    light = Light(rows, sample.row.take(rows), directions, value * strength[:, None])
    carrier.bring(paths, light, lambda coming: model.turned(met, rows, coming))


def scattered(paths: Paths, model: Model, met: Meeting, draw: Pair, carrier: Carrier) -> Paths:
    """Return paths that go on in random directions; those that would go through an opaque surface end."""
    directions, density, weight, band = model.scattered(met, *draw)
    side = dot(met.places.faces, directions)
    carried, band = carrier.scattered(paths, weight), paths.band if band is None else band
    onward = Paths(paths.number, _starts(met, model, side), directions, None, density, carried, band)
    return onward.only(np.nonzero(((side > 0) | model.transmits) & (density > 0))[0])


def _ways(
    met: Meeting, model: Model, sample: Sample, side: FloatArray, rows: IntArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """
    Return where some ways to lights start, their directions, and their lengths [m].

    The sample was seen from above the surface. What goes through starts below, but must not end deeper in the
    light than what starts above.
    """
    start, reach = _starts(met, model, side).take(rows, axis=1), sample.reach.take(rows)
    directions = sample.directions.take(rows, axis=1)
    if model.transmits:
        below = np.nonzero(side.take(rows) < 0)[0]
        shift = (met.places.start.take(rows, axis=1) - start)[:, below]
        way = directions[:, below].astype(float) * reach[below] + shift
        reach[below] = length(way)
        directions[:, below] = way / reach[below]
    return start, directions, reach


def _starts(met: Meeting, model: Model, side: FloatArray) -> FloatArray:
    """Return where rays start that leave to a side: 1 where the path came from, -1 the other."""
    return np.where(side > 0, met.places.start, met.places.behind) if model.transmits else met.places.start
