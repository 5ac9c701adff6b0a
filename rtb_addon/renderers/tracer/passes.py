"""
A picture from many paths: rounds of samples, tile by tile.

A round takes some samples of every pixel, spread evenly, and is independent of all others: from how far
rounds lie apart comes the standard error. Where nobody asks for errors, or to render until something,
one round takes all samples. Tiles bound the memory, whatever the size of the picture.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple, Protocol

import numpy as np

from ...errors import RenderingError
from ...scene.render_scene import IntArray, RenderScene
from ...spectra import FloatArray, Part
from ..interface import RenderOptions, Report
from .camera import rays
from .carried import Carrier
from .filters import offsets
from .integrate import FILM, LENS, Draw, World, follow, pairs_needed
from .intersect import around_zero, best_kernel
from .kernels import Kernel
from .paths import Paths
from .sampler import Sampler

# Paths in a tile, whose light is summed before it is multiplied out in all bands; and in a wave: few enough
# that its arrays stay in the processor's cache, enough that numpy's own overhead does not count.
TILE, WAVE = 2**15, 2**13
# Where rounds are needed: how many at least, and the most samples of a pixel in one.
_ROUNDS, _MOST = 8, 64
# Of the kind ``mean`` each path sees one of so many equal parts of every band.
_PARTS = 10


class Round(NamedTuple):
    """Some samples of every pixel: how many, and which of the independent rounds this is."""

    number: int
    samples: int


class Tile(NamedTuple):
    """Pixels of a round, in reading order of the part of the picture that is rendered."""

    round: Round
    first: int
    last: int


class Painter(Protocol):
    """What paints tiles, in their order."""

    kernel: str

    def paint(self, tiles: list[Tile], report: Callable[[float], None]) -> Iterator[FloatArray]:
        """Yield the (pixels, bands) mean radiance of each tile."""
        ...


class Picture(NamedTuple):
    """
    A picture, and how good it is.

    Parameters
    ----------
    radiance : (height, width, bands) float32 array [W sr-1 m-2 nm-1]
    standard_error : the same shape and unit, None where there was one round
    samples : of every pixel
    kernel : name of what found the triangles
    """

    radiance: FloatArray
    standard_error: FloatArray | None
    samples: int
    kernel: str


def render(
    scene: RenderScene, painter: Painter, options: RenderOptions, report: Report, clock=time.monotonic
) -> Picture:
    """Return the picture of a scene; report() hears what part is done and may raise Cancelled."""
    report(0.0)
    began, samples = clock(), scene.integrator.samples
    part, total = scene.film.part, None
    for one in rounds(samples, options):
        if total is not None and total.rounds >= 2 and _enough(total, options, clock() - began):
            break
        tiles = list(tiles_of(part.width * part.height, one))
        before, share = (total.samples if total else 0) / samples, one.samples / samples

        def rest(done: float, before: float = before, share: float = share) -> None:
            report(min(before + share * done, 1.0))

        total = _Sum(part.width * part.height, len(scene.film.bands)) if total is None else total
        total.add(one, zip(tiles, painter.paint(tiles, rest), strict=True))
    assert total is not None
    _check(total.mean, scene)
    report(1.0)
    shape = part.height, part.width, -1
    error = None if total.rounds < 2 else total.error().reshape(shape)
    return Picture(total.mean.reshape(shape), error, total.samples, painter.kernel)


def noise(radiance: FloatArray, error: FloatArray) -> float:
    """Return the relative noise: the root of the mean squared standard error over the mean radiance."""
    mean = float(radiance.mean(dtype=float))
    return float(np.sqrt(np.square(error, dtype=float).mean())) / mean if mean > 0 else 0.0


def rounds(samples: int, options: RenderOptions) -> Iterator[Round]:
    """Yield the rounds of a picture: one, or several where their spread or the time between them matters."""
    several = options.errors or options.error is not None or options.seconds is not None
    most = min(max(samples // _ROUNDS, 1), _MOST) if several else samples
    for number, first in enumerate(range(0, samples, most)):
        yield Round(number, min(most, samples - first))


def tiles_of(pixels: int, one: Round) -> Iterator[Tile]:
    """Yield the tiles of a round."""
    step = max(TILE // one.samples, 1)
    for first in range(0, pixels, step):
        yield Tile(one, first, min(first + step, pixels))


class _Sum:
    """The mean of rounds of different length and how far they lie apart (West 1979, Welford's update)."""

    def __init__(self, pixels: int, bands: int) -> None:
        self.mean = np.zeros((pixels, bands), np.float32)
        self.rounds = self.samples = 0
        self._apart: FloatArray | None = None

    def add(self, one: Round, tiles: Iterator[tuple[Tile, FloatArray]]) -> None:
        """Add a round, tile by tile."""
        self.samples += one.samples
        self.rounds += 1
        if self.rounds == 2:
            self._apart = np.zeros_like(self.mean)
        for tile, radiance in tiles:
            mean = self.mean[tile.first : tile.last]
            step = radiance - mean
            mean += step * np.float32(one.samples / self.samples)
            if self._apart is not None:
                self._apart[tile.first : tile.last] += np.float32(one.samples) * step * (radiance - mean)

    def error(self) -> FloatArray:
        """Return the standard error of the mean: a round of n samples varies 1 / n as much as one sample."""
        assert self._apart is not None
        return np.sqrt(np.maximum(self._apart, 0) / np.float32((self.rounds - 1) * self.samples))


def _enough(total: _Sum, options: RenderOptions, seconds: float) -> bool:
    if options.seconds is not None and seconds >= options.seconds:
        return True
    return options.error is not None and noise(total.mean, total.error()) <= options.error


class Alone:
    """Paints in this process: a scene's worlds, one for each part of the bands that its paths may see."""

    def __init__(self, scene: RenderScene, make: Callable[[FloatArray], Kernel] = best_kernel) -> None:
        self._scene = scene = around_zero(scene)
        self._worlds = [World.of(one, make) for one in _in_parts(scene)]
        self.kernel = self._worlds[0].surfaces.kernel.name

    def paint(self, tiles: list[Tile], report: Callable[[float], None]) -> Iterator[FloatArray]:
        """Yield the (pixels, bands) mean radiance of each tile."""
        for number, tile in enumerate(tiles):

            def part(done: float, number: int = number) -> None:
                report((number + done) / len(tiles))

            yield self.tile(tile, part)

    def tile(self, tile: Tile, report: Callable[[float], None] = lambda done: None) -> FloatArray:
        """Return the (pixels, bands) mean radiance of a tile."""
        scene, samples = self._scene, tile.round.samples
        pixels = _numbers(scene, np.arange(tile.first, tile.last))
        uses, seed = pairs_needed(scene.integrator), scene.integrator.seed
        sampler = Sampler(pixels, samples, uses, seed, tile.round.number)
        pixel = np.repeat(np.arange(len(pixels)), samples)
        sample = np.tile(np.arange(samples), len(pixels))
        part = (sample + sampler.turns.take(pixel)) % len(self._worlds)
        total, done = np.zeros((len(pixels), len(scene.film.bands)), np.float32), 0
        for number, world in enumerate(self._worlds):
            mine, carrier = np.nonzero(part == number)[0], world.carrier(len(pixels))
            with np.errstate(over="ignore"):  # what overflows is infinite, and refused by _check
                for first in range(0, len(mine), WAVE):
                    wave = mine[first : first + WAVE]
                    self._wave(world, carrier, Draw(sampler, pixel.take(wave), sample.take(wave)), pixels)
                    done += len(wave)
                    report(done / len(pixel))
                total += carrier.sums()
        return total / np.float32(samples)

    def _wave(self, world: World, carrier: Carrier, draw: Draw, pixels: IntArray) -> None:
        paths, weight = _from_camera(self._scene, draw, pixels)
        band = np.full(len(paths.number), -1) if world.materials.parts else None
        paths = paths._replace(carried=carrier.begin(draw.pixel, weight), band=band)
        follow(world, paths, draw, self._scene.integrator, carrier)


def _in_parts(scene: RenderScene) -> list[RenderScene]:
    """Return the scene, of the kind ``mean`` once for each part of its bands."""
    if scene.film.band_kind != "mean":
        return [scene]
    films = [replace(scene.film, band_kind=Part(number, _PARTS)) for number in range(_PARTS)]
    return [replace(scene, film=film) for film in films]


def _numbers(scene: RenderScene, places: IntArray) -> IntArray:
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
    lowest = 0 if scene.film.filter in ("box", "tent", "gaussian") else -np.inf
    wrong = np.argwhere(~(radiance >= lowest) | ~np.isfinite(radiance))
    if len(wrong):
        pixel, band = wrong[0]
        row, column = divmod(int(pixel), scene.film.part.width)
        raise RenderingError(
            f"the radiance at row {row}, column {column} is {radiance[pixel, band]:g} at"
            f" {scene.film.bands.centres[band]:g} nm, look for a light too bright or too near"
        )
