"""
The spectra of a scene as tables on the device, and which row belongs to which object of Mitsuba.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import copy
import math
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import BandKind, Bands, FloatArray, Spectrum
from .arrays import floats
from .band_parts import by_part, in_parts, parts_of
from .loaded import LoadedScene
from .lobes import Lobe, in_slots
from .one_hot import Emitter, OneHotScene
from .pictures import Pictures
from .sky_sampling import axes_of, uv_of

_NO_METAL = Lobe(Spectrum.constant(1.0))
_VOID = (Spectrum.constant(0.0), Spectrum.constant(0.0))
# A spectrum's row is fetched four numbers at a time.
_PACKET = 4
# An edge without a transition is this steep [1 / difference of cosines].
_HARD = 1e30


class Tables:
    """
    Spectra per band, beams and discs, looked up by material and emitter.

    Attributes
    ----------
    padded_bands : number of bands, rounded up to whole packets; the rest are zero
    lobes : most spectra that a material has
    pictures : those of the scene's lobes
    sky : the picture that is around the scene, by its emitter
    metals : most lobes of metals that a material has; they are its first
    constants : whether a material has a part that no spectrum multiplies
    beams : whether some emitter is a spot
    suns : number of emitters that are discs in the sky
    materials : ids of the materials, in the order of their rows
    all_bands : whether materials are asked for every band, not for lobes
    parts : how many parts a band has, of which each path takes one (see band_parts.py)
    single : whether there is one emitter, whose spectrum can wait until the end
    """

    def __init__(self, loaded: LoadedScene, source: OneHotScene, bands: Bands, kind: BandKind) -> None:
        self.padded_bands = -len(bands) % _PACKET + len(bands)
        self.materials = tuple(source.materials)
        self.parts, self._part = parts_of(kind), None
        self.lobes, self.metals = source.lobes, source.metals
        self.constants = any(lobe.constant for lobes in source.materials.values() for lobe in lobes)
        emitters = list(source.emitters.values())
        self.beams = any(emitter.outer > -2 for emitter in emitters)
        self.suns = sum(emitter.narrowness > 0 for emitter in emitters)
        # Many scenes have one lamp: its spectrum is then multiplied once a path instead of twice a bounce.
        pictured = [emitter for emitter in emitters if emitter.picture is not None]
        self.single = len(emitters) == 1 and self.suns == 0 and not pictured
        self.all_bands = source.wavelengths is not None
        self._fill(source, emitters, bands, kind)
        self.pictures = _pictures(source, bands, kind, self.padded_bands)
        shown = [Lobe(each.spectrum, picture=each.picture) for each in emitters]
        self.sky = Pictures(shown, bands, kind, self.padded_bands)
        turn = pictured[0].turn if pictured else np.eye(3)
        self._sky_axes = axes_of(turn)
        pointers = {id: mi.BSDFPtr(material) for id, material in loaded.materials.items()}
        self._bsdf_rows = _rows_by_pointer(pointers, source.materials)
        pointers = {id: mi.EmitterPtr(emitter) for id, emitter in loaded.emitters.items()}
        self._emitter_rows = _rows_by_pointer(pointers, source.emitters)

    def _fill(self, source: OneHotScene, emitters: list[Emitter], bands: Bands, kind: BandKind) -> None:
        def in_bands(spectrum) -> FloatArray:
            return in_parts(spectrum, bands, kind, self.padded_bands)

        black = np.zeros((self.parts, self.padded_bands))
        rows = [
            [black if lobe is None else in_bands(lobe.reflectance) for lobe in in_slots(lobes, self.lobes)]
            for lobes in source.materials.values()
        ]
        slots = [
            [lobe or _NO_METAL for lobe in in_slots(lobes, self.lobes)[: self.metals]]
            for lobes in source.materials.values()
        ]
        self._has_constant = mi.Bool(
            [any(lobe.constant for lobe in lobes) for lobes in source.materials.values()]
        )
        metals = [[lobe.index is not None for lobe in row] for row in slots]
        indices = [[[in_bands(part) for part in lobe.index or _VOID] for lobe in row] for row in slots]
        # Light sampling aims anywhere in a disc: irradiance becomes radiance times solid angle.
        gains = [2 / (2 - emitter.narrowness) for emitter in emitters]
        glows = [in_bands(emitter.spectrum) * gain for emitter, gain in zip(emitters, gains, strict=True)]
        if source.wavelengths is not None:
            places = by_part(source.wavelengths, kind, self.padded_bands)
            # Bands that fill up a packet are looked up as the first is, and come to nothing.
            self._wavelengths = floats(np.where(places > 0, places, places[:, :1]))
        self._reflectances = floats(rows)
        self._indices = floats(indices)
        self._is_metal = mi.Bool(np.ravel(metals) if self.metals else [False])
        self._emissions = floats(glows)
        self._beams = floats([[*e.axis, e.outer, _steepness(e), e.narrowness, 0.0, 0.0] for e in emitters])
        suns = [(e, glow) for e, glow in zip(emitters, glows, strict=True) if e.narrowness > 0]
        self._sun_radiances = floats([glow / (2 * math.pi * e.narrowness) for e, glow in suns])
        self._sun_narrowness = floats([e.narrowness for e, _ in suns])
        self._sun_directions = floats([np.negative(e.axis) for e, _ in suns])

    def for_parts(self, sampler) -> Tables:
        """Return the tables as paths see them that take some part of each band, each in its turn."""
        if self.parts == 1:
            return self
        # One number a path is spread evenly over a pixel's samples. Single precision rounds some up to 1.
        part = dr.minimum(mi.UInt32(sampler.next_1d() * self.parts), self.parts - 1)
        there = copy.copy(self)
        there._part = part
        there.pictures, there.sky = self.pictures.for_parts(part), self.sky.for_parts(part)
        return there

    def wavelengths(self) -> list:
        """Return where materials look up their spectra in the all-bands path, four bands at a time [nm]."""
        bands = self._bands(self._wavelengths, mi.UInt32(0), True)
        return [mi.Spectrum(*bands[start : start + 4]) for start in range(0, len(bands), 4)]

    def emitter_row(self, emitter, active) -> Any:
        """Return the row of each emitter."""
        return dr.gather(mi.UInt32, self._emitter_rows, numbers_of(emitter), active)

    def emission(self, row, towards, active) -> list | None:
        """
        Return an emitter's spectrum, one mi.Float a band; None where there is one even emitter only.

        Parameters
        ----------
        towards : directions in which the emitters are seen, for pictures of the sky
        """
        if self.single:
            return None
        black = [mi.Float(0)] * self.padded_bands
        plain = black if self.sky.everywhere else self._bands(self._emissions, row, active)
        if not self.sky.any:
            return plain
        local = mi.Vector3f(*(dr.dot(axis, towards) for axis in self._sky_axes))
        return self.sky.reflectance(row, uv_of(local), plain, active)

    def in_the_end(self, radiance: list) -> list:
        """Return what paths have gathered, times the spectrum of the only emitter, left out so far."""
        if not self.single:
            return radiance
        glow = self._bands(self._emissions, mi.UInt32(0), True)
        return [gathered * each for gathered, each in zip(radiance, glow, strict=True)]

    def material_row(self, bsdf, active) -> Any:
        """Return the row of each material."""
        return dr.gather(mi.UInt32, self._bsdf_rows, numbers_of(bsdf), active)

    def coefficients(self, row, colour, active) -> list:
        """Return the coefficients of a material's lobes from a colour of Mitsuba's."""
        found: list[Any] = [colour[k] for k in range(self.lobes)]
        if not self.constants:
            return found
        everywhere = dr.select(dr.gather(mi.Bool, self._has_constant, row, active), found[-1], 0)
        return [*(each - everywhere for each in found[:-1]), found[-1]]

    def reflectance(self, row, lobe: int, uv, active) -> list:
        """Return the spectrum of a material's lobe at a place on the surface, one mi.Float a band."""
        place = row * self.lobes + lobe
        plain = self._bands(self._reflectances, place, active)
        return self.pictures.reflectance(place, uv, plain, active) if self.pictures.any else plain

    def fresnel(self, row, lobe: int, cosines, active) -> list[list]:
        """Return what a metal's lobe reflects at angles, one mi.Float a band; 1 where it is no metal's."""
        place = row * self.metals + lobe
        metal = active & dr.gather(mi.Bool, self._is_metal, place, active)
        # Where no path of a bundle meets a metal, nothing is computed.
        return dr.if_stmt((place, list(cosines)), metal, self._fresnel, self._no_fresnel)

    def _fresnel(self, place, cosines) -> list[list]:
        eta, k = (self._bands(self._indices, place * 2 + part, True) for part in range(2))
        return [[_fresnel(cosine, *index) for index in zip(eta, k, strict=True)] for cosine in cosines]

    def _no_fresnel(self, place, cosines) -> list[list]:
        return [[mi.Float(1)] * self.padded_bands for _ in cosines]

    def beam(self, row, direction, active):
        """Return how much of a spot's intensity goes in a direction from it: Blender's smooth step."""
        if not self.beams:
            return mi.Float(1)
        first, second = self._beam(row, active)
        cosine = dr.dot(mi.Vector3f(first.x, first.y, first.z), direction)
        t = dr.clip((cosine - first.w) * second.x, 0, 1)
        return t * t * (3 - 2 * t)

    def narrowness(self, row, active) -> Any:
        """Return 1 - cosine of half the angle of an emitter's disc, 0 for those that are none."""
        return self._beam(row, active)[1].y

    def sun(self, index: int, direction):
        """Return whether a direction meets a sun's disc, and the disc's radiance, one mi.Float a band."""
        place = mi.UInt32(index)
        towards = dr.gather(mi.Vector3f, self._sun_directions, place)
        # 1 - cosine of a small angle, from the chord.
        apart = dr.squared_norm(towards - direction) / 2
        hit = apart < dr.gather(mi.Float, self._sun_narrowness, place)
        return hit, self._bands(self._sun_radiances, place, hit)

    def _beam(self, row, active) -> Any:
        return [dr.gather(mi.Vector4f, self._beams, row * 2 + half, active) for half in range(2)]

    def _bands(self, table, row, active) -> list:
        packets = self.padded_bands // _PACKET
        if self._part is not None:
            row = row * self.parts + self._part
        found: list[Any] = [dr.gather(mi.Vector4f, table, row * packets + k, active) for k in range(packets)]
        return [packet[k] for packet in found for k in range(_PACKET)]


def _pictures(source: OneHotScene, bands: Bands, kind: BandKind, padded: int) -> Pictures:
    rows = (in_slots(lobes, source.lobes) for lobes in source.materials.values())
    return Pictures([lobe for row in rows for lobe in row], bands, kind, padded)


def _fresnel(cosine, eta, k):
    """Return the share of unpolarised light that a conductor reflects; everything where eta and k are 0."""
    # Eta and k of 0 stand for no metal, and for the bands that fill up a packet.
    share: Any = mi.fresnel_conductor(cosine, mi.Complex2f(eta, k))  # pyright: ignore[reportCallIssue]
    return dr.select(eta + k > 0, share, 1)


def _steepness(emitter: Emitter) -> float:
    width = emitter.inner - emitter.outer
    return min(_HARD, 1 / width) if width > 0 else _HARD


def number_of(pointer) -> int:
    """Return Mitsuba's number of the object that a pointer points to."""
    return int(numbers_of(pointer)[0])


def numbers_of(pointer) -> Any:
    """Return Mitsuba's numbers of the objects that pointers point to; 0 is none."""
    return dr.reinterpret_array(mi.UInt32, pointer)


def _rows_by_pointer(pointers: dict, ids) -> Any:
    """Return a table from Mitsuba's numbers of objects to our rows."""
    order = {id: row for row, id in enumerate(ids)}
    numbers = {id: number_of(pointer) for id, pointer in pointers.items()}
    rows = np.zeros(max(numbers.values(), default=0) + 1, np.uint32)
    for id, number in numbers.items():
        rows[number] = order[id]
    return mi.UInt32(rows)
