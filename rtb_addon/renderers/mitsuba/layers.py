"""
What a picture knows beside radiance: one ray through the middle of each pixel, and light by its bounces.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any
from xml.etree import ElementTree as Xml

import drjit as dr
import mitsuba as mi
import numpy as np
from numpy.typing import NDArray

from ...layers import Layers
from ...spectra import FloatArray
from ..interface import RenderOptions, Report
from .band_groups import meet
from .camera_rays import CameraRays
from .loaded import LoadedScene
from .lobe_path import scatter
from .native import Native
from .object_numbers import by_number, numbers_of
from .passes import Picture, render_passes, sums_of, take
from .tables import Tables
from .xml.called import MATERIALS, OBJECTS

# Directions that tell how much of the light from the camera a surface would scatter.
_DIRECTIONS = 256
# Rays at a time.
_RAYS = 2**18


def render_layers(
    loaded: LoadedScene,
    tables: Tables,
    native: Native,
    names: Sequence[str],
    options: RenderOptions,
    report: Report,
) -> Layers:
    """Return some layers of a picture, out of layers.NAMES but the standard error."""
    seen = _Seen(loaded, tables, native)
    traced: dict[str, NDArray] = {name: _LAYERS[name](seen) for name in names if name in _LAYERS}
    if "albedo" in names:
        traced["albedo"] = _in_pixels(_albedo(seen), native)
    lit = {"direct", "indirect"} & set(names)
    by_bounce = _by_bounce(loaded, tables, native, lit, options, report) if lit else {}
    traced |= {name: by_bounce[name] for name in lit}
    numbered = {"object": native.names(OBJECTS), "material": native.names(MATERIALS)}
    spectral = lit or "albedo" in names
    return Layers(
        {name: traced[name] for name in names},
        native.bands if spectral else None,
        {name: tuple(numbered[name].values()) for name in numbered if name in names},
    )


class _Seen:
    """What the middles of pixels see, tile by tile."""

    def __init__(self, loaded: LoadedScene, tables: Tables, native: Native) -> None:
        self.loaded, self.tables, self.native = loaded, tables, native
        self.pixels = native.part.width * native.part.height
        self._rays = CameraRays(loaded.sensor, native)

    def at(self, pixel: Any) -> tuple[Any, Any]:
        """Return the rays through the middles of pixels and what they meet."""
        ray = self._rays.middle(pixel)
        return ray, self.loaded.scene.ray_intersect(ray, ray_flags=mi.RayFlags.All, coherent=True)

    def plane(self, numbers: Callable[[Any, Any], Sequence[Any]]) -> NDArray:
        """Return the (height, width) or (height, width, numbers) plane of a function of rays and meetings."""
        tiles = (numbers(*self.at(pixel)) for pixel in self.tiles())
        columns = [np.stack([np.array(each) for each in tile], axis=1) for tile in tiles]
        found = _in_pixels(np.concatenate(columns), self.native)
        return found[:, :, 0] if found.shape[2] == 1 else found

    def tiles(self, rays: int = 1) -> list[Any]:
        """Return the pixels in reading order, some at a time, where each takes so many rays."""
        size = max(1, _RAYS // rays)
        return [
            dr.arange(mi.UInt32, min(size, self.pixels - first)) + dr.opaque(mi.UInt32, first)
            for first in range(0, self.pixels, size)
        ]


def _depth(seen: _Seen) -> NDArray:
    matrix = _to_world(seen.native)
    axis = mi.Vector3f(*(matrix[:3, 2] / np.linalg.norm(matrix[:3, 2])).tolist())
    eye = mi.Point3f(*matrix[:3, 3].tolist())
    return seen.plane(lambda ray, si: [dr.select(si.is_valid(), dr.dot(si.p - eye, axis), dr.inf)])


def _normal(seen: _Seen) -> NDArray:
    return seen.plane(lambda ray, si: [dr.select(si.is_valid(), part, 0) for part in si.sh_frame.n])


def _uv(seen: _Seen) -> NDArray:
    known = _marks(seen.loaded.shapes, seen.loaded.unwrapped)
    return seen.plane(
        lambda ray, si: [dr.select(_marked(known, si) > 0, part, 0) for part in (si.uv.x, si.uv.y)]
    )


def _object(seen: _Seen) -> NDArray:
    known = _marks(seen.loaded.shapes, _ranks(seen.native.names(OBJECTS)))
    return seen.plane(lambda ray, si: [_marked(known, si)])


def _material(seen: _Seen) -> NDArray:
    pointers = {id: mi.BSDFPtr(material) for id, material in seen.loaded.materials.items()}
    known = by_number(pointers, _ranks(seen.native.names(MATERIALS)))
    return seen.plane(lambda ray, si: [dr.gather(mi.UInt32, known, numbers_of(si.bsdf()), si.is_valid())])


# Layers that a single ray tells.
_LAYERS: Mapping[str, Callable[[_Seen], NDArray]] = {
    "depth": _depth,
    "normal": _normal,
    "uv": _uv,
    "object": _object,
    "material": _material,
}


def _ranks(ids: Iterable[str]) -> dict[str, int]:
    return {id: rank for rank, id in enumerate(ids, start=1)}


def _marks(shapes: Mapping[str, Any], marks: Mapping[str, int]) -> Any:
    return by_number({name: mi.ShapePtr(shape) for name, shape in shapes.items()}, marks)


def _marked(table: Any, si: Any) -> Any:
    """Return the marks of shapes that rays meet; a mesh that is placed goes by its instance."""
    placed, shape = numbers_of(si.instance), numbers_of(si.shape)
    number = dr.select(placed > 0, placed, shape)
    # What is inside an instance has a number too, which may lie beyond the table.
    known = si.is_valid() & (number < dr.width(table))
    return dr.gather(mi.UInt32, table, number, known)


def _albedo(seen: _Seen) -> FloatArray:
    """Return the (pixels, bands) share of the light from the camera that surfaces scatter, per band."""
    bands, found = len(seen.native.bands), []
    sampler = seen.loaded.sensor.sampler().clone()
    sampler.set_sample_count(_DIRECTIONS)
    sampler.set_samples_per_wavefront(_DIRECTIONS)
    for tile, pixels in enumerate(seen.tiles(_DIRECTIONS)):
        lanes = dr.width(pixels) * _DIRECTIONS
        sampler.seed((seen.native.seed * 1_000_000_007 + tile) % 2**32, lanes)
        place = dr.arange(mi.UInt32, lanes) // _DIRECTIONS
        shares = _scattered(seen, sampler, dr.gather(mi.UInt32, pixels, place))
        found.append(sums_of(shares[:bands], place, dr.width(pixels)) / _DIRECTIONS)
    return np.concatenate(found)


def _scattered(seen: _Seen, sampler: Any, pixel: Any) -> list[Any]:
    """Return what share of each band one direction of scattering stands for."""
    tables = seen.tables.for_parts(sampler)
    _, si = seen.at(pixel)
    met, bsdf = si.is_valid(), si.bsdf()
    draws = sampler.next_1d(), sampler.next_2d()
    _, _, turn, onward = meet(tables, bsdf, si, si.wi, draws, met)
    even = [mi.Float(1)] * tables.padded_bands
    lit, turned = (turn.wo, onward, mi.Float(1)), (turn.wo, onward)
    _, spectral, scalar, _ = scatter(tables, even, mi.Float(1), (bsdf, si, met), lit, turned)
    return [dr.select(met, band * scalar, 0) for band in spectral]


def _by_bounce(
    loaded: LoadedScene,
    tables: Tables,
    native: Native,
    names: set[str],
    options: RenderOptions,
    report: Report,
) -> dict[str, FloatArray]:
    """Return the light that came by one bounce at most, and by more; they add up to the picture."""
    whole = render_passes(loaded, tables, native, options, lambda fraction: report(0.8 * fraction))
    # The same random numbers: what comes by one bounce is the same in both.
    short = Picture(loaded, tables, replace(native, depth=min(2, native.depth)), whole.samples)
    direct = take(short, whole.count, lambda fraction: report(0.8 + 0.2 * fraction)).mean()
    found = {"direct": direct, "indirect": whole.mean() - direct}
    return {name: _in_pixels(found[name], native).astype(np.float32) for name in names}


def _to_world(native: Native) -> FloatArray:
    words = next(_matrices(native.root)).get("value", "").split()
    return np.array([float(word) for word in words]).reshape(4, 4)


def _matrices(root: Xml.Element):
    return (matrix for sensor in root.iter("sensor") for matrix in sensor.iter("matrix"))


def _in_pixels(values: NDArray, native: Native) -> NDArray:
    return values.reshape(native.part.height, native.part.width, -1)
