"""
From the camera to the light: a path tracer over many paths at once.

Paths leave the camera in waves. At every surface that they meet they look for a light (next-event
estimation), then go on in a random direction, where they may find a light as well; both ways together are
weighed by the balance heuristic (Veach and Guibas, *Optimally Combining Sampling Techniques*, 1995).
No path ends by chance: its length is its integrator's depth.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import RenderingError
from ...scene.render_scene import Film, IntArray, RenderScene
from ...spectra import FloatArray
from ..interface import Report
from .camera import rays
from .directions import dot
from .intersect import Surfaces, best_kernel
from .kernels import Hits, Kernel
from .lights import Lights
from .materials import Materials
from .meeting import Meeting, Model, column
from .paths import Paths
from .sampler import Sampler

# Paths in a wave: few enough that its arrays stay in the processor's cache and that
# cancelling takes no time, enough that numpy's own overhead does not count.
WAVE = 4096

Pair = tuple[FloatArray, FloatArray]


class World(NamedTuple):
    """A scene, ready to be met by rays."""

    surfaces: Surfaces
    materials: Materials
    lights: Lights

    @classmethod
    def of(cls, scene: RenderScene, kernel: Callable[[FloatArray], Kernel]) -> World:
        """Return a scene's world, its rays found by a kernel."""
        materials = Materials(scene.materials, scene.film, scene.textures)
        surfaces = Surfaces(scene.shapes, materials.numbers, kernel, materials.oriented, materials.textured)
        return cls(surfaces, materials, Lights(scene, surfaces))

    def meet(self, origins: FloatArray, directions: FloatArray, reach: FloatArray | None) -> Hits:
        """Return what rays meet first, triangles or lights that are solid."""
        return self.lights.spheres.before(self.surfaces.meet(origins, directions, reach), origins, directions)

    def blocked(self, origins: FloatArray, directions: FloatArray, reach: FloatArray) -> NDArray[np.bool_]:
        """Return which rays meet anything before their reach."""
        way = origins, directions, reach
        return self.surfaces.blocked(*way) | self.lights.spheres.block(*way)


def render(
    scene: RenderScene, report: Report, kernel: Callable[[FloatArray], Kernel] = best_kernel
) -> tuple[FloatArray, str]:
    """
    Return the picture of a scene and the name of the ray kernel.

    The picture is a (height, width, bands) float32 array [W sr-1 m-2 nm-1]. Tiles bound the memory; each
    is summed in the same order, so the same scene gives the same bits.
    """
    report(0.0)
    world = World.of(scene, kernel)
    pixels = scene.film.width * scene.film.height
    picture = np.empty((pixels, len(scene.film.bands)), np.float32)
    for tile, first in enumerate(range(0, pixels, WAVE)):
        last = min(first + WAVE, pixels)

        def part(done: float, first: int = first, last: int = last) -> None:
            report((first + done * (last - first)) / pixels)

        picture[first:last] = _tile(scene, world, tile, np.arange(first, last), part)
    _check(picture, scene.film)
    return picture.reshape(scene.film.height, scene.film.width, -1), world.surfaces.kernel.name


def _tile(
    scene: RenderScene, world: World, tile: int, pixels: IntArray, report: Callable[[float], None]
) -> FloatArray:
    """Return the (pixels, bands) mean radiance of some pixels, a wave of samples at a time."""
    depth, samples = _depth(scene), scene.integrator.samples
    # The last one is for the lens.
    uses = (2 if world.materials.mixtures is None else 3) * depth
    sampler = Sampler(len(pixels), samples, uses, scene.integrator.seed, tile)
    together = max(WAVE // len(pixels), 1)
    total = np.zeros((len(pixels), len(scene.film.bands)))
    for first in range(0, samples, together):
        count = min(together, samples - first)
        draw = _Draw(sampler, len(pixels), first)
        paths = _from_camera(scene, draw, np.tile(pixels, count))
        with np.errstate(over="ignore"):  # what overflows is infinite, and refused by _check
            light = follow(world, paths, draw, depth)
        total += light.reshape(count, len(pixels), -1).sum(axis=0)
        report((first + count) / samples)
    return total / samples


class _Draw(NamedTuple):
    """The random numbers of a wave: sample after sample of all pixels of a tile."""

    sampler: Sampler
    pixels: int
    first: int

    def pair(self, use: int, number: IntArray) -> Pair:
        sample, pixel = np.divmod(number, self.pixels)
        return self.sampler.pair(use, pixel, self.first + sample)


def _from_camera(scene: RenderScene, draw: _Draw, pixels: IntArray) -> Paths:
    """Return paths through random places of pixels: the box filter."""
    film = scene.film
    number = np.arange(len(pixels))
    u, v = draw.pair(0, number)
    row, column = np.divmod(pixels, film.width)
    lens = draw.pair(-1, number) if scene.camera.lens_radius else None
    origins, directions, reach = rays(scene.camera, (column + u) / film.width, (row + v) / film.height, lens)
    throughput = np.ones((len(pixels), len(film.bands)), np.float32)
    return Paths(number, origins, directions, reach, np.full(len(pixels), np.inf), throughput)


def follow(world: World, paths: Paths, draw: _Draw, depth: int) -> FloatArray:
    """Follow paths to the end and return the (paths, bands) radiance that they found."""
    found = np.zeros_like(paths.throughput)
    for step in range(1, depth + 1):
        hits = world.meet(paths.origins, paths.directions, paths.reach)
        _add_met(world, paths, hits, found)
        if step == depth:
            break
        meetings = _met_surfaces(world, paths, hits, draw, 2 * depth - 2 + step)
        # What is not needed any more makes room in the processor's cache.
        del paths, hits
        paths = _gone_on(world, meetings, draw, step, found)
        if not len(paths.number):
            break
    return found


def _add_met(world: World, paths: Paths, hits: Hits, found: FloatArray) -> None:
    """
    Add the lights that paths met by themselves.

    The balance heuristic: scattering chose this direction with one density, looking for a light
    would have with a rival one, so it counts for density / (density + rival).
    """
    for rows, row, strength, rival in world.lights.met(hits, paths.origins, paths.directions):
        if len(rows):
            light = world.lights.coming(row, paths.directions.take(rows, axis=1))
            light *= column(strength / (1 + rival / paths.density[rows]))
            _add(paths, rows, light, found)


def _gone_on(
    world: World, meetings: list[tuple[Model, Paths, Meeting]], draw: _Draw, step: int, found: FloatArray
) -> Paths:
    """Look for lights from where paths met surfaces, and return the paths that go on."""
    parts = []
    while meetings:
        model, paths, met = meetings.pop()
        _add_sampled(world, paths, model, met, draw.pair(2 * step - 1, paths.number), found)
        parts.append(_scattered(paths, model, met, draw.pair(2 * step, paths.number)))
    return Paths.joined(parts, len(world.lights.spectra[0]))


def _met_surfaces(
    world: World, paths: Paths, hits: Hits, draw: _Draw, use: int
) -> list[tuple[Model, Paths, Meeting]]:
    """
    Return the paths that met a surface which is not black, by how it scatters, and what they met.

    What is made of several materials is one of them, by chance.
    """
    rows = np.nonzero(hits.triangle >= 0)[0]
    material = world.surfaces.material.take(hits.triangle.take(rows))
    if world.materials.mixtures is not None:
        material = world.materials.mixtures.one_of(material, draw.pair(use, paths.number[rows])[0])
    bright = world.materials.reflects.take(material)
    rows, material = rows[bright], material[bright]
    meetings = []
    for model, where, row in world.materials.sorted(material):
        theirs, some = paths.only(rows[where]), hits.only(rows[where])
        met = Meeting(row, world.surfaces.places(some, theirs.directions), theirs.directions)
        if (factor := model.shared(met)) is not None:
            # In place even where nothing was left out: nobody asks for the paths as they came.
            np.multiply(theirs.throughput, factor, out=theirs.throughput)
        meetings.append((model, theirs, met))
    return meetings


def _add_sampled(
    world: World, paths: Paths, model: Model, met: Meeting, draw: Pair, found: FloatArray
) -> None:
    """
    Look for a light from every place, and add it where the way is free.

    f cos / density, times the balance heuristic density / (density + rival) where scattering could have
    met the light as well; the rival density is that of scattering.
    """
    sample = None if model.single else world.lights.sample(met.places.start, *draw)
    if sample is None:
        return
    side = dot(met.places.faces, sample.directions)
    rows = np.nonzero((sample.strength > 0) & ((side > 0) | model.transmits))[0]
    start, directions = _starts(met, model, side).take(rows, axis=1), sample.directions.take(rows, axis=1)
    free = np.nonzero(~world.blocked(start, directions, sample.reach.take(rows)))[0]
    rows, directions = rows.take(free), directions.take(free, axis=1)
    value, rival = model.evaluate(met, rows, sample.directions)
    strength = sample.strength.take(rows) / (sample.density.take(rows) + sample.extended.take(rows) * rival)
    light = world.lights.coming(sample.row.take(rows), directions)
    light *= value * column(strength)
    _add(paths, rows, light, found)


def _add(paths: Paths, rows: IntArray, light: FloatArray, found: FloatArray) -> None:
    """Add the (n, bands) light that comes to some paths, times their throughput; band by band."""
    light *= paths.throughput.take(rows, axis=0)
    found[paths.number.take(rows)] += light


def _scattered(paths: Paths, model: Model, met: Meeting, draw: Pair) -> Paths:
    """Return paths that go on in random directions; those that would go through an opaque surface end."""
    directions, density, weight = model.scattered(met, *draw)
    side = dot(met.places.faces, directions)
    throughput = paths.throughput if weight is None else paths.throughput * weight
    onward = Paths(paths.number, _starts(met, model, side), directions, None, density, throughput)
    return onward.only(np.nonzero(((side > 0) | model.transmits) & (density > 0))[0])


def _starts(met: Meeting, model: Model, side: FloatArray) -> FloatArray:
    """Return where rays start that leave to a side: 1 where the path came from, -1 the other."""
    return np.where(side > 0, met.places.start, met.places.behind) if model.transmits else met.places.start


def _depth(scene: RenderScene) -> int:
    """Return the length of the longest paths; direct light is a path of two."""
    depth = scene.integrator.depth
    return min(depth, 2) if scene.integrator.kind == "direct" else depth


def _check(picture: FloatArray, film: Film) -> None:
    """Raise RenderingError for radiance that cannot be."""
    wrong = np.argwhere(~(picture >= 0) | ~np.isfinite(picture))
    if len(wrong):
        pixel, band = wrong[0]
        row, column = divmod(int(pixel), film.width)
        raise RenderingError(
            f"the radiance at row {row}, column {column} is {picture[pixel, band]:g} at"
            f" {film.bands.centres[band]:g} nm, look for a light too bright or too near"
        )
