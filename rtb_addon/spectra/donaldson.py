"""
Fluorescent materials: how much light of one wavelength comes back as light of another.

A Donaldson matrix holds, for each incoming and outgoing wavelength, the radiance factor as instruments
measure it: outgoing spectrum = matrix times incoming spectrum, both per nanometre at the steps of the matrix.
Where both wavelengths are one it is the plain reflectance.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import RecipeError
from ..exr import read_exr
from .bands import BandKind, Bands, FloatArray, Part
from .spectrum import Spectrum

_NM = r"(\d+(?:[.,]\d+)?)nm"
# As Fichet, Pacanowski and Wilkie, *An OpenEXR Layout for Spectral Images*, 2021: incoming, then outgoing.
_CHANNEL = re.compile(rf"T\.{_NM}(?:\.{_NM})?")
_COMMENT = re.compile(r"[#%].*")


@dataclass(frozen=True, eq=False)
class Donaldson:
    """
    The matrix of a material.

    Parameters
    ----------
    incoming, outgoing : (n,) and (m,) arrays, increasing [nm]
    shares : (m, n) array, 0 or more
    """

    incoming: FloatArray
    outgoing: FloatArray
    shares: FloatArray

    @property
    def reflectance(self) -> Spectrum:
        """What comes back as it came."""
        same = self._same()
        if not same.any():
            return Spectrum.constant(0.0)
        out, into = np.nonzero(same)
        return Spectrum.of(self.outgoing[out], self.shares[out, into])

    @property
    def exciting(self) -> tuple[float, float] | None:
        """From where to where light comes back as another [nm], None where it never does."""
        active = np.nonzero(self._turning().any(axis=0))[0]
        if not len(active):
            return None
        edges = _steps(self.incoming)
        return float(edges[active[0]]), float(edges[active[-1] + 1])

    def in_bands(self, bands: Bands, kind: BandKind | Part) -> tuple[FloatArray, FloatArray]:
        """
        Return the (bands,) reflectance, and the (bands, bands) shares, out and in, that change their band.

        Light is even within a band, a step of the matrix even within its step; so with bands that are the
        steps the shares are the matrix itself.
        """
        into, out = _overlap(self.incoming, bands), _overlap(self.outgoing, bands)
        into /= np.diff(_steps(self.incoming))[:, None]
        out /= bands.widths
        return self.reflectance.in_bands(bands, kind), out.T @ self._turning() @ into

    def _same(self) -> NDArray[np.bool_]:
        return np.abs(self.outgoing[:, None] - self.incoming) < 1e-3

    def _turning(self) -> FloatArray:
        return np.where(self._same(), 0, self.shares)


def read_donaldson(path: Path) -> Donaldson:
    """
    Read a matrix, from a spectral EXR or a table.

    A table has the incoming wavelengths [nm] on its first line, and on each other line an outgoing wavelength
    [nm] and a share for each incoming one; ``#`` and ``%`` begin comments. An EXR has channels
    ``T.400,000000nm`` and ``T.300,000000nm.400,000000nm``, incoming first, and one pixel, or pixels that are
    all the same.
    """
    found = _from_exr(path) if path.suffix.lower() == ".exr" else _from_table(path)
    for wavelengths in (found.incoming, found.outgoing):
        if len(wavelengths) < 2 or (np.diff(wavelengths) <= 0).any():
            raise RecipeError("wavelengths must increase, and be two at least, in and out", path)
    if not (np.isfinite(found.shares).all() and found.shares.min() >= 0):
        raise RecipeError("it holds numbers below 0 or none at all, a share of light is 0 or more", path)
    return found


def _from_exr(path: Path) -> Donaldson:
    entries: dict[tuple[float, float], float] = {}
    for name, plane in read_exr(path)[1].items():
        if match := _CHANNEL.fullmatch(name):
            first = _nm(match.group(1))
            if np.ptp(plane):
                raise RecipeError(f"the pixels of {name} differ, give a picture of one even material", path)
            entries[first, _nm(match.group(2) or match.group(1))] = float(plane.flat[0])
    if not entries:
        raise RecipeError("no channels like T.300,000000nm.400,000000nm, give a bispectral picture", path)
    incoming, outgoing = (np.unique(each) for each in zip(*entries, strict=True))
    shares = np.zeros((len(outgoing), len(incoming)))
    for (into, out), share in entries.items():
        shares[np.searchsorted(outgoing, out), np.searchsorted(incoming, into)] = share
    return Donaldson(incoming, outgoing, shares)


def _nm(text: str) -> float:
    return float(text.replace(",", "."))


def _from_table(path: Path) -> Donaldson:
    rows = []
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise RecipeError("not a text file, give a table or a bispectral EXR", path) from error
    except OSError as error:
        raise RecipeError(f"cannot read {path}: {error.strerror}") from error
    for number, line in enumerate(lines, 1):
        try:
            row = [float(word) for word in _COMMENT.sub("", line).replace(",", " ").split()]
        except ValueError as error:
            raise RecipeError(f"{line.strip()[:40]!r} are no numbers", path, number) from error
        if row and rows and len(row) != len(rows[0]) + 1:
            message = f"{len(row)} numbers, want an outgoing wavelength and {len(rows[0])} shares"
            raise RecipeError(message, path, number)
        if row:
            rows.append(row)
    if len(rows) < 2:
        raise RecipeError("no table, want incoming wavelengths, then a line for each outgoing one", path)
    table = np.array(rows[1:])
    return Donaldson(np.array(rows[0]), table[:, 0], table[:, 1:])


def _steps(wavelengths: FloatArray) -> FloatArray:
    """Return the edges of the steps about wavelengths [nm]."""
    return Bands.around(wavelengths.tolist()).edges


def _overlap(wavelengths: FloatArray, bands: Bands) -> FloatArray:
    """Return the (steps, bands) widths that steps about wavelengths and bands have in common [nm]."""
    edges = _steps(wavelengths)
    low = np.maximum(edges[:-1, None], bands.edges[:-1])
    return np.maximum(np.minimum(edges[1:, None], bands.edges[1:]) - low, 0)
