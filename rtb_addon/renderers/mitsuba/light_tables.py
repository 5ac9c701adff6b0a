"""
The lights of a scene as tables on the device, and which row belongs to which emitter of Mitsuba.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import BandKind, Bands
from .arrays import floats
from .band_parts import in_parts, parts_of
from .loaded import LoadedScene
from .lobes import Lobe
from .object_numbers import numbers_of, rows_by_number
from .one_hot import Emitter
from .packets import Rows, padded
from .pictures import Pictures
from .sky_sampling import axes_of, uv_of

# An edge without a transition is this steep [1 / difference of cosines].
_HARD = 1e30


class LightTables:
    """
    Spectra per band, beams and discs, looked up by emitter.

    Attributes
    ----------
    sky : the picture that is around the scene, by its emitter
    beams : whether some emitter is a spot
    suns : number of emitters that are discs in the sky
    single : whether there is one emitter, whose spectrum can wait until the end
    """

    def __init__(self, loaded: LoadedScene, by_id: dict[str, Emitter], bands: Bands, kind: BandKind) -> None:
        emitters, self._bands = list(by_id.values()), padded(len(bands))
        self.beams = any(emitter.outer > -2 for emitter in emitters)
        self.suns = sum(emitter.narrowness > 0 for emitter in emitters)
        # Many scenes have one lamp: its spectrum is then multiplied once a path instead of twice a bounce.
        pictured = [emitter for emitter in emitters if emitter.picture is not None]
        self.single = len(emitters) == 1 and self.suns == 0 and not pictured
        self._fill(emitters, bands, kind)
        shown = [Lobe(each.spectrum, picture=each.picture) for each in emitters]
        self.sky, self._part = Pictures(shown, bands, kind, self._bands), None
        self._sky_axes = axes_of(pictured[0].turn if pictured else np.eye(3))
        pointers = {id: mi.EmitterPtr(emitter) for id, emitter in loaded.emitters.items()}
        self._rows = rows_by_number(pointers, by_id)

    def _fill(self, emitters: Sequence[Emitter], bands: Bands, kind: BandKind) -> None:
        # Light sampling aims anywhere in a disc: irradiance becomes radiance times solid angle.
        gains = [2 / (2 - emitter.narrowness) for emitter in emitters]
        glows = [
            in_parts(emitter.spectrum, bands, kind, self._bands) * gain
            for emitter, gain in zip(emitters, gains, strict=True)
        ]
        shape = parts_of(kind), self._bands
        self._emissions = Rows(glows, *shape)
        self._beams = floats([[*e.axis, e.outer, _steepness(e), e.narrowness, 0.0, 0.0] for e in emitters])
        suns = [(e, glow) for e, glow in zip(emitters, glows, strict=True) if e.narrowness > 0]
        self._sun_radiances = Rows([glow / (2 * math.pi * e.narrowness) for e, glow in suns], *shape)
        self._sun_narrowness = floats([e.narrowness for e, _ in suns])
        self._sun_directions = floats([np.negative(e.axis) for e, _ in suns])

    def for_parts(self, part) -> LightTables:
        """Return the tables as paths see them that take some part of each band, a mi.UInt32."""
        there = copy.copy(self)
        there._part, there.sky = part, self.sky.for_parts(part)
        return there

    def row(self, emitter, active) -> Any:
        """Return the row of each emitter."""
        return dr.gather(mi.UInt32, self._rows, numbers_of(emitter), active)

    def emission(self, row, towards, active) -> list | None:
        """
        Return an emitter's spectrum, one mi.Float a band; None where there is one even emitter only.

        Parameters
        ----------
        towards : directions in which the emitters are seen, for pictures of the sky
        """
        if self.single:
            return None
        black = [mi.Float(0)] * self._bands
        plain = black if self.sky.everywhere else self._emissions.at(row, self._part, active)
        if not self.sky.any:
            return plain
        local = mi.Vector3f(*(dr.dot(axis, towards) for axis in self._sky_axes))
        return self.sky.reflectance(row, uv_of(local), plain, active)

    def in_the_end(self, radiance: list) -> list:
        """Return what paths have gathered, times the spectrum of the only emitter, left out so far."""
        if not self.single:
            return radiance
        glow = self._emissions.at(mi.UInt32(0), self._part, True)
        return [gathered * each for gathered, each in zip(radiance, glow, strict=True)]

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
        return hit, self._sun_radiances.at(place, self._part, hit)

    def _beam(self, row, active) -> Any:
        return [dr.gather(mi.Vector4f, self._beams, row * 2 + half, active) for half in range(2)]


def _steepness(emitter: Emitter) -> float:
    width = emitter.inner - emitter.outer
    return min(_HARD, 1 / width) if width > 0 else _HARD
