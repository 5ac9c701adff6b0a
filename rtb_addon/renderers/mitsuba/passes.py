"""
Rendering with the lobe path: rounds of tiles of pixels, progress after each tile.

A round gives every pixel the same samples, of few pixels at a time, since samples are spread evenly only
within one tile. Rounds are independent, so that their spread is the noise of the picture. They do not depend
on the number of threads, and are added up in order.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import FloatArray
from ..interface import RenderOptions, Report
from ..rounds import Progress, Rounds, rounds_of
from .camera_rays import CameraRays
from .loaded import LoadedScene
from .lobe_path import path_radiance
from .native import Native
from .tables import Tables

# Paths of a tile, for some 32 bands: some tenths of a second on one thread.
_PATHS = 2**18


@dataclass(frozen=True)
class Tile:
    """Some samples of some pixels: a range of pixels in reading order, and the seed."""

    first: int
    pixels: int
    seed: int


class Picture:
    """A scene that is rendered round by round."""

    def __init__(self, loaded: LoadedScene, tables: Tables, native: Native, samples: int) -> None:
        self._scene, self._tables, self._native = loaded.scene, tables, native
        self._rays = CameraRays(loaded.sensor, native)
        self._sampler = loaded.sensor.sampler()
        self._sampler.set_sample_count(samples)
        # Some counts cannot be spread evenly, and a few samples more can.
        self.samples: int = self._sampler.sample_count()
        self._sampler.set_samples_per_wavefront(self.samples)
        roulette = dr.opaque(mi.UInt32, native.roulette) if native.roulette else None
        self._limits = dr.opaque(mi.UInt32, native.depth), roulette

    def round(self, number: int, between: Callable[[float], None]) -> FloatArray:
        """
        Return the (pixels, bands) mean of a round's samples.

        Parameters
        ----------
        between : called before each tile with the fraction of the round that is done
        """
        part, bands = self._native.part, len(self._native.bands)
        paths = _PATHS // max(1, bands // 32)
        found = np.empty((part.width * part.height, bands))
        for tile in tiles(len(found), self.samples, number, self._native.seed, paths):
            between(tile.first / len(found))
            found[tile.first : tile.first + tile.pixels] = self._tile(tile)
        return found / self.samples

    def _tile(self, tile: Tile) -> FloatArray:
        """Return the (pixels, bands) sums of a tile's samples."""
        # What is older than the tile becomes a block of its own to drjit, which would else put numbers that
        # all share elsewhere in the kernel when it has seen them before, and compile another one.
        dr.detail.new_scope(dr.backend_v(mi.Float))
        sampler, lanes = self._sampler.clone(), tile.pixels * self.samples
        sampler.seed(tile.seed, lanes)
        pixel = dr.arange(mi.UInt32, lanes) // self.samples
        ray, worth = self._rays.sample(sampler, pixel + dr.opaque(mi.UInt32, tile.first))
        tables = self._tables.for_parts(sampler)
        radiance = path_radiance(self._scene, tables, sampler, ray, worth, self._limits)
        return sums_of(radiance[: len(self._native.bands)], pixel, tile.pixels)


def sums_of(radiance: list[Any], pixel: Any, pixels: int) -> FloatArray:
    """Return the (pixels, bands) sums of what paths carried, by their pixels."""
    bands = len(radiance)
    sums = dr.zeros(mi.Float, pixels * bands)
    for band, values in enumerate(radiance):
        dr.scatter_reduce(dr.ReduceOp.Add, sums, values, pixel * bands + band, mode=dr.ReduceMode.Local)
    return np.array(sums).reshape(pixels, bands)


def render_passes(
    loaded: LoadedScene, tables: Tables, native: Native, options: RenderOptions, report: Report
) -> Rounds:
    """Return the rounds of a picture, as many as its samples or the options want."""
    count, each = rounds_of(native.samples, options)
    picture = Picture(loaded, tables, native, each)
    rounds, progress = Rounds(picture.samples), Progress(count, options, report)
    while rounds.count < count and not progress.is_enough(rounds):
        rounds.add(picture.round(rounds.count, progress.within(rounds.count)))
    report(1.0)
    return rounds


def take(picture: Picture, count: int, report: Report) -> Rounds:
    """Return just so many rounds of a picture."""
    rounds, progress = Rounds(picture.samples), Progress(count, RenderOptions(), report)
    while rounds.count < count:
        rounds.add(picture.round(rounds.count, progress.within(rounds.count)))
    return rounds


def tiles(pixels: int, samples: int, number: int, seed: int, paths: int) -> Iterator[Tile]:
    """Yield the tiles of a round, of so many paths, in reading order."""
    size = max(1, paths // samples)
    for index, first in enumerate(range(0, pixels, size)):
        # Seeds of different recipes lie far apart, a large prime from each other.
        place = number * -(-pixels // size) + index
        yield Tile(first, min(size, pixels - first), (seed * 1_000_000_007 + place) % 2**32)
