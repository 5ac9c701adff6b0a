"""
Rays into a scene: through random places of pixels, as filter and lens say, or through their middles.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from typing import Any

import drjit as dr
import mitsuba as mi

from ..filters import filter_of
from .arrays import floats
from .native import Native


class CameraRays:
    """Rays through the pixels of the part of a picture that is rendered, counted in reading order."""

    def __init__(self, sensor: Any, native: Native) -> None:
        self._sensor, self._native = sensor, native
        self._filter = filter_of(native.filter)
        self._places = floats(self._filter.places)
        self._stretch, self._across, self._down = (
            dr.opaque(mi.Float, number) for number in (native.pixel_stretch, *native.shift)
        )
        corner = native.part.left, native.part.top, native.part.width, native.width, native.height
        self._left, self._top, self._columns, self._width, self._height = (
            dr.opaque(mi.UInt32, number) for number in corner
        )

    def sample(self, sampler: Any, pixel: Any) -> tuple[Any, Any]:
        """Return a ray through a random place around the middle of each pixel, and its weight."""
        u, v = sampler.next_2d()
        (x, weight), (y, other) = self._offset(u), self._offset(v)
        lens = sampler.next_2d() if self._native.has_lens else mi.Point2f(0.5)
        return self._ray(pixel, x, y, lens), weight * other

    def middle(self, pixel: Any) -> Any:
        """Return a ray through the middle of each pixel, and of the lens."""
        return self._ray(pixel, mi.Float(0), mi.Float(0), mi.Point2f(0.5))

    def _offset(self, number: Any) -> tuple[Any, Any]:
        """Return how far from the middle of its pixel [pixels] a path begins, and its weight."""
        if self._native.filter == "box":
            return number - 0.5, mi.Float(1)
        count = dr.width(self._places) - 1
        place = number * count
        index = dr.minimum(mi.UInt32(place), count - 1)
        before, after = (dr.gather(mi.Float, self._places, index + k) for k in (0, 1))
        offset = dr.lerp(before, after, place - mi.Float(index))
        weight = mi.Float(self._filter.gain)
        for zero in self._filter.zeros:
            weight = dr.select(dr.abs(offset) < zero, weight, -weight)
        return offset, weight

    def _ray(self, pixel: Any, x: Any, y: Any, lens: Any) -> Any:
        row = pixel // self._columns
        column = pixel - row * self._columns
        x = (mi.Float(column + self._left) + 0.5 + x) / mi.Float(self._width)
        y = (mi.Float(row + self._top) + 0.5 + y) / mi.Float(self._height)
        if self._native.pixel_stretch != 1:
            y = (y - 0.5) * self._stretch + 0.5
        if any(self._native.shift):
            x, y = x + self._across, y + self._down
        ray, _ = self._sensor.sample_ray(0.0, 0.5, mi.Point2f(x, y), lens)
        return mi.Ray3f(ray)
