"""
Rendering with the lobe path: tiles of pixels, a pass each, progress between them.

A pass takes many samples of few pixels, since samples are spread evenly only within one pass. Passes do not
depend on the number of threads, and are added up in order.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import FloatArray
from ..interface import Report
from .loaded import LoadedScene
from .lobe_path import path_radiance
from .native import Native
from .tables import Tables

# Paths of a pass, for some 32 bands: some tenths of a second on one thread.
_PATHS = 2**18
# More samples of a pixel than this are taken in several passes.
_MOST_SAMPLES = 256


@dataclass(frozen=True)
class Pass:
    """Some samples of some pixels: a range of pixels in reading order, and the seed."""

    first: int
    pixels: int
    seed: int


def render_passes(
    loaded: LoadedScene, tables: Tables, native: Native, report: Report
) -> tuple[FloatArray, int]:
    """Return the (height, width, bands) radiance [W sr-1 m-2 nm-1] and how many samples a pixel had."""
    rounds = -(-native.samples // _MOST_SAMPLES)
    sampler = loaded.sensor.sampler()
    sampler.set_sample_count(-(-native.samples // rounds))
    # Some counts cannot be spread evenly, and a few samples more can.
    samples = sampler.sample_count()
    sampler.set_samples_per_wavefront(samples)
    total = np.zeros((native.width * native.height, len(native.bands)))
    paths = _PATHS // max(1, len(native.bands) // 32)
    planned = list(plan(native.width * native.height, samples, rounds, native.seed, paths))
    depth = dr.opaque(mi.UInt32, native.depth)
    for done, one in enumerate(planned):
        report(done / len(planned))
        sums = _render(loaded, tables, sampler.clone(), native, one, depth)
        total[one.first : one.first + one.pixels] += sums
    report(1.0)
    mean = total / (samples * rounds)
    return mean.reshape(native.height, native.width, -1).astype(np.float32), samples * rounds


def plan(pixels: int, samples: int, rounds: int, seed: int, paths: int) -> Iterator[Pass]:
    """Yield the passes of a picture, of so many paths, in the order in which they are added up."""
    tile = max(1, paths // samples)
    number = 0
    for _ in range(rounds):
        for first in range(0, pixels, tile):
            # Seeds of different recipes lie far apart, a large prime from each other.
            yield Pass(first, min(tile, pixels - first), (seed * 1_000_000_007 + number) % 2**32)
            number += 1


def _render(loaded, tables, sampler, native: Native, one: Pass, depth) -> FloatArray:
    """Return the (pixels, bands) sums of a pass's samples."""
    samples = sampler.sample_count()
    lanes = one.pixels * samples
    sampler.seed(one.seed, lanes)
    pixel = dr.arange(mi.UInt32, lanes) // samples
    ray = _camera_ray(loaded.sensor, sampler, native, pixel + dr.opaque(mi.UInt32, one.first))
    radiance = path_radiance(loaded.scene, tables, sampler, ray, depth)
    bands = len(native.bands)
    sums = dr.zeros(mi.Float, one.pixels * bands)
    for band in range(bands):
        place = pixel * bands + band
        dr.scatter_reduce(dr.ReduceOp.Add, sums, radiance[band], place, mode=dr.ReduceMode.Local)
    return np.array(sums).reshape(one.pixels, bands)


def _camera_ray(sensor, sampler, native: Native, pixel):
    """Return a ray through a random place of each pixel."""
    width, height = (dr.opaque(mi.UInt32, size) for size in (native.width, native.height))
    row = pixel // width
    u, v = sampler.next_2d()
    x = (mi.Float(pixel - row * width) + u) / mi.Float(width)
    y = (mi.Float(row) + v) / mi.Float(height)
    if native.pixel_stretch != 1:
        y = (y - 0.5) * dr.opaque(mi.Float, native.pixel_stretch) + 0.5
    ray, _ = sensor.sample_ray(0.0, 0.5, mi.Point2f(x, y), mi.Point2f(0.5))
    return mi.Ray3f(ray)
