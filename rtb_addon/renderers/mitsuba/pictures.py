"""
The pictures of a scene on the device, band by band.

Pictures of a few channels, as colours become, keep them and are multiplied out where a path meets them; of
others each texel is kept as its bands.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np

from ...spectra import BandKind, Bands, FloatArray
from ..pictures import Picture, read_picture
from .lobes import Lobe
from .picture_lookup import Layout, taps
from .textures_xml import WRAPS

# Channels that are kept as they are: a packet that memory gives at once.
_FEW = 4
# Numbers for each lobe: first texel, width, height, wrap, nearest, then none, few or many channels as 0, 1 or
# 2, and the row where the bands of few channels begin.
_NUMBERS, _KIND, _ROW = 8, 5, 6


class Pictures:
    """
    Pictures looked up by the lobe that they belong to.

    Attributes
    ----------
    any : whether some lobe has one
    """

    def __init__(self, lobes: Sequence[Lobe | None], bands: Bands, kind: BandKind, padded: int) -> None:
        self._packets = padded // _FEW
        few, many, weights = [], [], []
        layout = np.zeros((len(lobes), _NUMBERS), np.uint32)
        places = np.zeros((len(lobes), 4), np.float32)
        for number, lobe in enumerate(lobes):
            if lobe is None or (use := lobe.picture) is None:
                continue
            picture = read_picture(use.file, use.gamma)
            height, width, channels = picture.texels.shape
            small = channels <= _FEW
            into = few if small else many
            first = sum(len(block) for block in into)
            into.append(_as_stored(picture, bands, kind, padded))
            kept = (1 if small else 2), len(weights) * _FEW
            layout[number, :7] = first, width, height, WRAPS.index(use.wrap), use.nearest, *kept
            places[number] = use.place
            weights.append(_weights(picture, bands, kind, padded))
        self.any = bool(weights)
        self._few, self._many = bool(few), bool(many)
        self._layout, self._places = mi.UInt32(layout.ravel()), _table([places])
        self._few_texels, self._many_texels, self._weights = _table(few), _table(many), _table(weights)

    def reflectance(self, lobe, uv, plain: list, active) -> list:
        """Return the spectrum of a lobe's picture at a place, or the plain one where it has none."""
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
        row = self._number(lobe, _ROW, True)
        total: list[Any] = [mi.Float(0)] * len(plain)
        for k in range(_FEW):
            weights = _bands(self._weights, row + k, self._packets)
            total = [
                dr.fma(channels[k], weight, so_far) for weight, so_far in zip(weights, total, strict=True)
            ]
        return total

    def _of_bands(self, lobe, uv, plain: list) -> list:
        total: list[Any] = [mi.Float(0)] * len(plain)
        for texel, share in self._around(lobe, uv):
            values = _bands(self._many_texels, texel, self._packets)
            total = [dr.fma(share, value, so_far) for value, so_far in zip(values, total, strict=True)]
        return total


def _as_it_is(lobe, uv, plain: list) -> list:
    return plain


def _as_stored(picture: Picture, bands: Bands, kind: BandKind, padded: int) -> FloatArray:
    """Return (texels, numbers) of a picture: its few channels, or its bands."""
    flat = picture.texels.reshape(-1, picture.texels.shape[2])
    if flat.shape[1] > _FEW:
        flat = flat @ picture.weights(bands, kind).astype(np.float32)
        return np.pad(flat, ((0, 0), (0, padded - flat.shape[1])))
    return np.pad(flat, ((0, 0), (0, _FEW - flat.shape[1])))


def _weights(picture: Picture, bands: Bands, kind: BandKind, padded: int) -> FloatArray:
    weights = picture.weights(bands, kind)[:_FEW]
    return np.pad(weights, ((0, _FEW - len(weights)), (0, padded - weights.shape[1])))


def _bands(table, row, packets: int) -> list:
    found: list[Any] = [dr.gather(mi.Vector4f, table, row * packets + k) for k in range(packets)]
    return [packet[k] for packet in found for k in range(_FEW)]


def _table(blocks) -> Any:
    flat = np.concatenate([np.ravel(block) for block in blocks]) if blocks else np.zeros(_FEW)
    return mi.Float(flat.astype(np.float32))
