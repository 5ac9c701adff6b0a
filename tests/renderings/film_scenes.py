"""Scenes whose pictures tell a film's filter and crop, for the tests of every renderer."""

from dataclasses import replace

import numpy as np

from rtb_addon.renderers.filters import FILTERS
from rtb_addon.scene.render_scene import Camera, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.mitsuba_scenes import DOWN, at, lamp, scene, square

BANDS = Bands.regular(450, 100, 3)
GLOW = Spectrum.constant(2.0)
EDGE = 0.3  # of a pixel to the right of the middle of the picture


def framed(camera, shapes, size, samples=1024, lights=(), **film):
    one = scene(lights, shapes, camera=camera, bands=BANDS, samples=samples, size=size)
    return replace(one, film=replace(one.film, **film))


def from_above(half=0.0, to_world=None, window=None, **lens):
    window = window or (-half, half, -half, half)
    return Camera("Camera", "perspective", at(0, 0, 2) if to_world is None else to_world, window, **lens)


def half_plane(name, samples=1024):
    """Sixteen pixels across a plane that shines to the right of an edge, each a unit wide."""
    camera = Camera("Camera", "orthographic", at(0, 0, 2), (-8.0, 8.0, -4.0, 4.0))
    bright = Shape("Bright", square(20), at(20 + EDGE, 0, 0), "soot", GLOW)
    return framed(camera, [bright], (16, 8), samples, filter=name)


def edge_spread(name):
    """Return what part of a filter lies beyond the edge, for each column of pixels."""
    evaluate, radius, _ = FILTERS[name]
    x = np.linspace(-radius, radius, 200_001)
    heights = evaluate(x)
    sums = np.cumsum(heights) / heights.sum()
    return 1 - np.interp(EDGE - (np.arange(16) - 7.5), x, sums, left=0.0, right=1.0)


def lit_floor(**film):
    floor = Shape("Floor", square(5), DOWN, "paint")
    lights = [lamp("point", at(0.4, -0.3, 1), radius=0.0)]
    return framed(from_above(window=(-0.6, 0.6, -0.4, 0.4)), [floor], (24, 16), 1024, lights, **film)
