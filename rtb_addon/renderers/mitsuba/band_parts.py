"""
Bands in parts, for the true mean of products of spectra.

The mean of a product over a band is not the product of means. For bands of the kind mean every path takes one
of ten equal parts of every band, by turns, and sees all spectra as their averages over that part: the same
paths at the same price, and the mean is that over the band up to what varies within a tenth of it.
"""

from __future__ import annotations

import numpy as np

from ...spectra import PARTS, BandKind, Bands, FloatArray, Spectrum


def parts_of(kind: BandKind) -> int:
    """Return how many parts bands of a kind have."""
    return PARTS if kind == "mean" else 1


def divided(bands: Bands, kind: BandKind) -> tuple[Bands, BandKind]:
    """Return bands that are parts of bands, and what is asked of each."""
    if kind != "mean":
        return bands, kind
    steps = np.arange(PARTS) / PARTS
    starts = (bands.edges[:-1, None] + bands.widths[:, None] * steps).ravel()
    edges = np.append(starts, bands.edges[-1])
    return Bands((edges[1:] + edges[:-1]) / 2, edges), "averaged"


def by_part(values: FloatArray, kind: BandKind, padded: int) -> FloatArray:
    """Return (..., parts, padded) numbers of (..., bands x parts) ones, 0 where there is no band."""
    parts = parts_of(kind)
    found = np.swapaxes(values.reshape(*values.shape[:-1], -1, parts), -1, -2)
    return np.pad(found, [(0, 0)] * (found.ndim - 1) + [(0, padded - found.shape[-1])])


def in_parts(spectrum: Spectrum, bands: Bands, kind: BandKind, padded: int) -> FloatArray:
    """Return the (parts, padded) values of a spectrum in the parts of bands."""
    return by_part(spectrum.in_bands(*divided(bands, kind)), kind, padded)
