"""
The spectra of a scene as tables on the device, and which row belongs to which material of Mitsuba.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import copy
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import BandKind, Bands, Spectrum
from .band_parts import by_part, in_parts, parts_of
from .light_tables import LightTables
from .loaded import LoadedScene
from .lobes import Lobe, in_slots
from .object_numbers import numbers_of, rows_by_number
from .one_hot import OneHotScene
from .packets import Rows, padded
from .pictures import Pictures

_NO_METAL = Lobe(Spectrum.constant(1.0))
_VOID = (Spectrum.constant(0.0), Spectrum.constant(0.0))


class Tables:
    """
    Spectra per band, looked up by material, and those of the lights.

    Attributes
    ----------
    padded_bands : number of bands, rounded up to whole packets; the rest are zero
    lights : what emitters shine
    lobes : most spectra that a material has
    pictures : those of the scene's lobes
    metals : most lobes of metals that a material has; they are its first
    constants : whether a material has a part that no spectrum multiplies
    all_bands : whether materials are asked for every band, not for lobes
    parts : how many parts a band has, of which each path takes one (see band_parts.py)
    """

    def __init__(self, loaded: LoadedScene, source: OneHotScene, bands: Bands, kind: BandKind) -> None:
        self.padded_bands = padded(len(bands))
        self.parts, self._part = parts_of(kind), None
        self.lobes, self.metals = source.lobes, source.metals
        self.constants = any(lobe.constant for lobes in source.materials.values() for lobe in lobes)
        self.all_bands = source.wavelengths is not None
        if source.wavelengths is not None:
            places = by_part(source.wavelengths, kind, self.padded_bands)
            # Bands that fill up a packet are looked up as the first is, and come to nothing.
            self._wavelengths = self._in_rows(np.where(places > 0, places, places[:, :1]))
        self._fill(source, bands, kind)
        self.lights = LightTables(loaded, source.emitters, bands, kind)
        pointers = {id: mi.BSDFPtr(material) for id, material in loaded.materials.items()}
        self._rows = rows_by_number(pointers, source.materials)

    def _fill(self, source: OneHotScene, bands: Bands, kind: BandKind) -> None:
        slots = [in_slots(lobes, self.lobes) for lobes in source.materials.values()]
        self.pictures = Pictures([lobe for row in slots for lobe in row], bands, kind, self.padded_bands)

        def in_bands(spectrum: Spectrum):
            return in_parts(spectrum, bands, kind, self.padded_bands)

        black = np.zeros((self.parts, self.padded_bands))
        self._reflectances = self._in_rows(
            [[black if lobe is None else in_bands(lobe.reflectance) for lobe in row] for row in slots]
        )
        metals = [[lobe or _NO_METAL for lobe in row[: self.metals]] for row in slots]
        self._indices = self._in_rows(
            [[[in_bands(part) for part in lobe.index or _VOID] for lobe in row] for row in metals]
        )
        known = [lobe.index is not None for row in metals for lobe in row]
        self._is_metal = mi.Bool(known or [False])
        constant = [any(lobe.constant for lobe in lobes) for lobes in source.materials.values()]
        self._has_constant = mi.Bool(constant)

    def _in_rows(self, values) -> Rows:
        return Rows(values, self.parts, self.padded_bands)

    def for_parts(self, sampler) -> Tables:
        """Return the tables as paths see them that take some part of each band, each in its turn."""
        if self.parts == 1:
            return self
        # One number a path is spread evenly over a pixel's samples. Single precision rounds some up to 1.
        part = dr.minimum(mi.UInt32(sampler.next_1d() * self.parts), self.parts - 1)
        there = copy.copy(self)
        there._part = part
        there.pictures, there.lights = self.pictures.for_parts(part), self.lights.for_parts(part)
        return there

    def wavelengths(self) -> list:
        """Return where materials look up their spectra in the all-bands path, four bands at a time [nm]."""
        bands = self._wavelengths.at(mi.UInt32(0), self._part, True)
        return [mi.Spectrum(*bands[start : start + 4]) for start in range(0, len(bands), 4)]

    def material_row(self, bsdf, active) -> Any:
        """Return the row of each material."""
        return dr.gather(mi.UInt32, self._rows, numbers_of(bsdf), active)

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
        plain = self._reflectances.at(place, self._part, active)
        return self.pictures.reflectance(place, uv, plain, active) if self.pictures.any else plain

    def fresnel(self, row, lobe: int, cosines, active) -> list[list]:
        """Return what a metal's lobe reflects at angles, one mi.Float a band; 1 where it is no metal's."""
        place = row * self.metals + lobe
        metal = active & dr.gather(mi.Bool, self._is_metal, place, active)
        # Where no path of a bundle meets a metal, nothing is computed.
        return dr.if_stmt((place, list(cosines)), metal, self._fresnel, self._no_fresnel)

    def _fresnel(self, place, cosines) -> list[list]:
        eta, k = (self._indices.at(place * 2 + part, self._part, True) for part in range(2))
        return [[_fresnel(cosine, *index) for index in zip(eta, k, strict=True)] for cosine in cosines]

    def _no_fresnel(self, place, cosines) -> list[list]:
        return [[mi.Float(1)] * self.padded_bands for _ in cosines]


def _fresnel(cosine, eta, k):
    """Return the share of unpolarised light that a conductor reflects; everything where eta and k are 0."""
    # Eta and k of 0 stand for no metal, and for the bands that fill up a packet.
    share: Any = mi.fresnel_conductor(cosine, mi.Complex2f(eta, k))  # pyright: ignore[reportCallIssue]
    return dr.select(eta + k > 0, share, 1)
