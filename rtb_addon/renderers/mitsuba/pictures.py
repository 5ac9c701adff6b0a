"""
The pictures of a scene on the device, band by band.

Pictures of a few channels, as colours become, keep them and are multiplied out where a path meets them; of
others each texel is kept as its bands.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import BandKind, Bands, FloatArray, Spectrum
from ..pictures import Picture, read_picture
from .arrays import floats
from .band_parts import by_part, divided, parts_of
from .lobes import Lobe, PictureUse
from .packets import PACKET, fetch
from .picture_lookup import Layout, taps
from .xml.textures import ALL_WRAPS

# Channels that are kept as they are.
_FEW = PACKET
# Numbers for each lobe: first texel, width, height, wrap, nearest, then none, few or many channels as 0, 1 or
# 2, and the row where the bands of few channels begin.
_NUMBERS, _KIND, _ROW = 8, 5, 6


class Pictures:
    """
    Pictures looked up by the lobe that they belong to.

    Attributes
    ----------
    any : whether some lobe has one
    everywhere : whether every lobe has one of few channels
    """

    def __init__(self, lobes: Sequence[Lobe | None], bands: Bands, kind: BandKind, padded: int) -> None:
        self._packets, self._part = padded // _FEW, None
        store = _Store(bands, kind, padded)
        layout = np.zeros((len(lobes), _NUMBERS), np.uint32)
        places = np.zeros((len(lobes), 4), np.float32)
        for number, lobe in enumerate(lobes):
            if lobe is not None and (use := lobe.picture) is not None:
                first, width, height, kept, row = store.add(use, lobe.reflectance)
                ways = ALL_WRAPS.index(use.wrap), use.nearest
                layout[number, :7] = first, width, height, *ways, kept, row
                places[number] = use.place
        self._few, self._many = bool(store.few), bool(store.many)
        self.any = self._few or self._many
        self._layout, self._places = mi.UInt32(layout.ravel()), floats(places)
        tables = (_table(blocks) for blocks in (store.few, store.many, store.weights))
        self._few_texels, self._many_texels, self._weights = tables
        self._shared = _shared(store, padded)
        self.everywhere = self._few and bool((layout[:, _KIND] == 1).all())

    def for_parts(self, part) -> Pictures:
        """Return the pictures as paths see them that take some part of each band, a mi.UInt32."""
        there = copy.copy(self)
        there._part = part
        return there

    def reflectance(self, lobe, uv, plain: list, active) -> list:
        """Return the spectrum of a lobe's picture at a place, or the plain one where it has none."""
        if self.everywhere:
            return self._of_channels(lobe, uv, plain)
        kind = self._number(lobe, _KIND, active)
        # Where no path of a bundle meets a picture, nothing is looked up.
        if self._few:
            plain = dr.if_stmt((lobe, uv, plain), active & (kind == 1), self._of_channels, _as_it_is)
        if self._many:
            plain = dr.if_stmt((lobe, uv, plain), active & (kind == 2), self._of_bands, _as_it_is)
        return plain

    def _around(self, lobe, uv) -> list[tuple[Any, Any]]:
        first, width, height, wrap, nearest = (self._number(lobe, k, True) for k in range(5))
        place = dr.gather(mi.Vector4f, self._places, lobe)
        return taps(Layout(first, width, height, wrap, nearest, place), uv)

    def _number(self, lobe, which: int, active) -> Any:
        return dr.gather(mi.UInt32, self._layout, lobe * _NUMBERS + which, active)

    def _of_channels(self, lobe, uv, plain: list) -> list:
        channels: Any = mi.Vector4f(0)
        for texel, share in self._around(lobe, uv):
            channels += share * dr.gather(mi.Vector4f, self._few_texels, texel)
        if self._shared and self._part is None:
            return [
                sum((channels[k] * weights[k] for k in range(_FEW)), mi.Float(0)) for weights in self._shared
            ]
        row = self._number(lobe, _ROW, True)
        if self._part is not None:
            row += self._part * _FEW
        total: list[Any] = [mi.Float(0)] * len(plain)
        for k in range(_FEW):
            weights = fetch(self._weights, row + k, self._packets)
            total = [
                dr.fma(channels[k], weight, so_far) for weight, so_far in zip(weights, total, strict=True)
            ]
        return total

    def _of_bands(self, lobe, uv, plain: list) -> list:
        total: list[Any] = [mi.Float(0)] * len(plain)
        for texel, share in self._around(lobe, uv):
            values = fetch(self._many_texels, texel, self._packets)
            total = [dr.fma(share, value, so_far) for value, so_far in zip(values, total, strict=True)]
        return total


def _shared(store: _Store, padded: int) -> list[list[Any]]:
    """Return the weights of the only picture of few channels, in memory: each band's, each channel's."""
    if len(store.weights) != 1 or not store.few:
        return []
    weights = np.reshape(store.weights[0], (-1, _FEW, padded))[0]
    return [[dr.opaque(mi.Float, float(weight)) for weight in column] for column in weights.T]


def _as_it_is(lobe, uv, plain: list) -> list:
    return plain


class _Store:
    """Collects the texels of pictures, each once however many surfaces show it."""

    def __init__(self, bands: Bands, kind: BandKind, padded: int) -> None:
        self.few: list[FloatArray] = []
        self.many: list[FloatArray] = []
        self.weights: list[FloatArray] = []
        self._how = bands, kind, padded
        self._known: dict[tuple, tuple[int, ...]] = {}

    def add(self, use: PictureUse, spectrum: Spectrum) -> tuple[int, ...]:
        """Return the first texel, width, height, kind, and row of weights of a picture times a spectrum."""
        key = use.file, use.gamma, spectrum.wavelengths.tobytes(), spectrum.values.tobytes()
        if key not in self._known:
            picture = read_picture(use.file, use.gamma)
            bands, kind, padded = self._how
            finer = divided(bands, kind)
            weights = by_part(picture.weights(*finer) * spectrum.in_bands(*finer), kind, padded)
            height, width, channels = picture.texels.shape
            kept, into = (1, self.few) if channels <= _FEW else (2, self.many)
            first = sum(len(block) for block in into)
            row = len(self.weights) * _FEW * parts_of(kind)
            self._known[key] = first, width, height, kept, row
            into.append(_as_stored(picture, weights.mean(axis=1)))
            self.weights.append(_few_weights(weights))
        return self._known[key]


def _as_stored(picture: Picture, weights: FloatArray) -> FloatArray:
    """Return (texels, numbers) of a picture: its few channels, or its bands."""
    flat = picture.texels.reshape(-1, picture.texels.shape[2])
    if flat.shape[1] > _FEW:
        return flat @ weights.astype(np.float32)
    return np.pad(flat, ((0, 0), (0, _FEW - flat.shape[1])))


def _few_weights(weights: FloatArray) -> FloatArray:
    """Return the (parts, 4, bands) weights of few channels."""
    few = np.swapaxes(weights[:_FEW], 0, 1)
    return np.pad(few, ((0, 0), (0, _FEW - few.shape[1]), (0, 0)))


def _table(blocks) -> Any:
    return floats(np.concatenate([np.ravel(block) for block in blocks]) if blocks else np.zeros(_FEW))
