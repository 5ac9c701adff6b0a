"""
A picture from many paths: rounds of samples, tile by tile.

A round takes some samples of every pixel, spread evenly, and is independent of all others (../rounds.py).
Tiles bound the memory, whatever the size of the picture.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from ...errors import RenderingError
from ...scene.render_scene import IntArray, RenderScene
from ...spectra import PARTS, FloatArray, Part
from ..filters import FILTERS
from ..interface import RenderOptions, Report
from ..rounds import Progress, Rounds, rounds_of
from .camera import rays
from .carried import Carrier
from .film import offsets
from .integrate import FILM, LENS, Draw, World, follow, pairs_needed
from .intersect import best_kernel
from .kernels import Kernel
from .materials.fluorescence import widened
from .paths import Paths
from .placed import around_zero
from .sampler import Sampler

# Paths in a tile, whose light is summed before it is multiplied out in all bands; and in a wave: few enough
# that its arrays stay in the processor's cache, enough that numpy's own overhead does not count.
TILE, WAVE = 2**15, 2**14


class Tile(NamedTuple):
    """
    Some samples of some pixels.

    Parameters
    ----------
    first, last : the pixels, in reading order of the part of the picture that is rendered
    samples : of each
    number : of the round
    """

    first: int
    last: int
    samples: int
    number: int


class Painter(Protocol):
    """What paints tiles."""

    kernel: str

    def paint(self, tiles: Sequence[Tile], report: Callable[[float], None]) -> Iterator[FloatArray]:
        """Yield the (pixels, bands) mean radiance of each tile, in their order."""
        ...


def render(scene: RenderScene, painter: Painter, options: RenderOptions, report: Report) -> Rounds:
    """
    Return the rounds of a picture, each of a (height, width, bands) float32 array [W sr-1 m-2 nm-1].

    Calls report() with the fraction done; it may raise Cancelled.
    """
    wanted = scene.integrator.samples
    count, samples = rounds_of(wanted, options, memory=wanted)
    rounds, progress = Rounds(samples), Progress(count, options, report)
    while rounds.count < count and not progress.is_enough(rounds):
        rounds.add(render_round(scene, painter, samples, rounds.count, progress.within(rounds.count)))
    _check(rounds.mean(), scene)
    report(1.0)
    return rounds


def render_round(
    scene: RenderScene, painter: Painter, samples: int, number: int, tell: Callable[[float], None]
) -> FloatArray:
    """Return the (height, width, bands) mean radiance of one round; tell() hears what part of it is done."""
    tell(0.0)
    part = scene.film.part
    tiles = list(_tiles(part.width * part.height, samples, number))
    picture = np.empty((part.width * part.height, len(scene.film.bands)), np.float32)
    for tile, radiance in zip(tiles, painter.paint(tiles, tell), strict=True):
        picture[tile.first : tile.last] = radiance
    return picture.reshape(part.height, part.width, -1)


def _tiles(pixels: int, samples: int, number: int) -> Iterator[Tile]:
    step = max(TILE // samples, 1)
    for first in range(0, pixels, step):
        yield Tile(first, min(first + step, pixels), samples, number)


class Alone:
    """
    Paints in this process: a scene's worlds, one for each part of the bands that its paths may see.

    Attributes
    ----------
    seen : which bands of the worlds are the film's; others excite what is fluorescent
    """

    def __init__(self, scene: RenderScene, make: Callable[[FloatArray], Kernel] = best_kernel) -> None:
        self.scene = scene = around_zero(scene)
        wide, self.seen = widened(scene)
        self.worlds = [World.of(one, make) for one in _in_parts(wide)]
        self.kernel = self.worlds[0].surfaces.kernel.name

    def paint(self, tiles: Sequence[Tile], report: Callable[[float], None]) -> Iterator[FloatArray]:
        """Yield the (pixels, bands) mean radiance of each tile."""
        for number, tile in enumerate(tiles):

            def part(done: float, number: int = number) -> None:
                report((number + done) / len(tiles))

            yield self.tile(tile, part)

    def tile(self, tile: Tile, report: Callable[[float], None] = lambda done: None) -> FloatArray:
        """Return the (pixels, bands) mean radiance of a tile."""
        scene, samples = self.scene, tile.samples
        pixels = numbers_of(scene, np.arange(tile.first, tile.last))
        uses, seed = pairs_needed(scene.integrator), scene.integrator.seed
        sampler = Sampler(pixels, samples, uses, seed, tile.number)
        pixel = np.repeat(np.arange(len(pixels)), samples)
        sample = np.tile(np.arange(samples), len(pixels))
        part = (sample + sampler.turns.take(pixel)) % len(self.worlds)
        total, done = np.zeros((len(pixels), len(scene.film.bands)), np.float32), 0
        for number, world in enumerate(self.worlds):
            mine, carrier = np.nonzero(part == number)[0], world.carrier(len(pixels))
            with np.errstate(over="ignore"):  # what overflows is infinite, and refused by _check
                for first in range(0, len(mine), WAVE):
                    wave = mine[first : first + WAVE]
                    self._wave(world, carrier, Draw(sampler, pixel.take(wave), sample.take(wave)), pixels)
                    done += len(wave)
                    report(done / len(pixel))
                total += carrier.sums()[:, self.seen]
        return total / np.float32(samples)

    def _wave(self, world: World, carrier: Carrier, draw: Draw, pixels: IntArray) -> None:
        paths, weight = _from_camera(self.scene, draw, pixels)
        band = np.full(len(paths.number), -1) if world.materials.parts else None
        paths = paths._replace(carried=carrier.begin(draw.pixel, weight), band=band)
        follow(world, paths, draw, self.scene.integrator, carrier)


def _in_parts(scene: RenderScene) -> list[RenderScene]:
    """Return the scene, of the kind ``mean`` once for each part of its bands."""
    if scene.film.band_kind != "mean":
        return [scene]
    films = [replace(scene.film, band_kind=Part(number, PARTS)) for number in range(PARTS)]
    return [replace(scene, film=film) for film in films]


def numbers_of(scene: RenderScene, places: IntArray) -> IntArray:
    """Return the numbers in the whole picture of pixels of the part that is rendered."""
    part = scene.film.part
    row, column = np.divmod(places, part.width)
    return (row + part.top) * scene.film.width + column + part.left


def _from_camera(scene: RenderScene, draw: Draw, pixels: IntArray) -> tuple[Paths, FloatArray | None]:
    """Return paths through places of pixels that the film's filter has chosen, and how much each counts."""
    film = scene.film
    number = np.arange(len(draw.pixel))
    x, y, weight = offsets(film.filter, *draw.pair(0, FILM, number))
    row, column = np.divmod(pixels.take(draw.pixel), film.width)
    across, down = (column + 0.5 + x) / film.width, (row + 0.5 + y) / film.height
    lens = [draw.pair(0, LENS, number)] if scene.camera.lens_radius else []
    origins, directions, reach = rays(scene.camera, across, down, *lens)
    density = np.full(len(number), np.inf, np.float32)
    return Paths(number, origins, directions.astype(np.float32), reach, density, number), weight


def _check(radiance: FloatArray, scene: RenderScene) -> None:
    """Raise RenderingError for radiance that cannot be; a filter with negative lobes may make some of it."""
    lowest = -np.inf if FILTERS[scene.film.filter][2] else 0
    for row, line in enumerate(radiance):
        wrong = np.argwhere(~(line >= lowest) | ~np.isfinite(line))
        if len(wrong):
            column, band = wrong[0]
            raise RenderingError(
                f"the radiance at row {row}, column {column} is {line[column, band]:g} at"
                f" {scene.film.bands.centres[band]:g} nm, look for a light too bright or too near"
            )
