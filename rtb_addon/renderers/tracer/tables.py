"""Spectra as the tracer computes with them: a row each, a column per band."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from ...errors import RenderingError
from ...scene.render_scene import Film, Material, TextureUse
from ...spectra import FloatArray, Spectrum

if TYPE_CHECKING:
    from .meeting import Meeting

# Products of a light and a few distances must stay within single precision.
_LARGEST = 1e30


class Lookup(Protocol):
    """A texture ready to be asked."""

    def at(self, uvs: FloatArray) -> FloatArray:
        """Return (n, bands) float32 spectra at (2, n) texture coordinates."""
        ...


class Colours:
    """
    One spectrum for each material of a kind, or a texture of spectra.

    Parameters
    ----------
    rows : (materials, bands) float32 array
    textures : materials' rows -> what is looked up instead

    Attributes
    ----------
    plain : (materials, bands) float32 array, or None where there are textures
    bright : (materials,) bool array, False for those that are black in every band
    """

    def __init__(self, rows: FloatArray, textures: Mapping[int, Lookup]) -> None:
        self._rows, self._textures = rows, textures
        self.plain: FloatArray | None = None if textures else rows
        self.bright: NDArray[np.bool_] = rows.any(axis=1)
        self.bright[list(textures)] = True

    def at(self, met: Meeting) -> FloatArray:
        """Return the (n, bands) float32 spectra where paths met surfaces."""
        found = self._rows.take(met.row, axis=0)
        for row, texture in self._textures.items():
            where = np.nonzero(met.row == row)[0]
            if len(where) and met.places.uvs is not None:
                found[where] = texture.at(met.places.uvs.take(where, axis=1))
        return found


class Palette(NamedTuple):
    """What makes colours out of the parameters of materials."""

    film: Film
    textures: Mapping[str, Lookup]

    def colours(self, materials: Sequence[Material], name: str) -> Colours:
        """Return the spectra of one parameter of materials."""
        said = [one.parameters[name] for one in materials]
        used = {row: value.texture for row, value in enumerate(said) if isinstance(value, TextureUse)}
        return Colours(self.rows(materials, name), {row: self.textures[id] for row, id in used.items()})

    def rows(self, materials: Sequence[Material], name: str) -> FloatArray:
        """Return the (materials, bands) float32 band values of one parameter, 0 where it is a texture."""
        said = [one.parameters[name] for one in materials]
        named = [
            (f"{name} of material {one.id}", 0.0 if isinstance(value, TextureUse) else value)
            for one, value in zip(materials, said, strict=True)
        ]
        return table(named, self.film)


def numbers(materials: Sequence[Material], name: str) -> FloatArray:
    """Return the (materials,) numbers of one parameter of materials; of a spectrum its first value."""
    said = [one.parameters[name] for one in materials]
    return np.array([one.values[0] if isinstance(one, Spectrum) else one for one in said], float)


def table(named: Sequence[tuple[str, object]], film: Film) -> FloatArray:
    """
    Return the (spectra, bands) float32 band values of spectra or plain numbers.

    Each comes with what it is called in the RenderingError that names one with numbers that cannot be.
    """
    rows = np.zeros((len(named), len(film.bands)))
    for row, (name, value) in zip(rows, named, strict=True):
        spectrum = value if isinstance(value, Spectrum) else Spectrum.constant(float(value))  # type: ignore[arg-type]
        row[:] = spectrum.in_bands(film.bands, film.band_kind)
        if wrong := [band for band in range(len(row)) if not 0 <= row[band] < _LARGEST]:
            place = f"{row[wrong[0]]:g} at {film.bands.centres[wrong[0]]:g} nm"
            raise RenderingError(f"{name} is {place}, give numbers from 0 to {_LARGEST:g}")
    return rows.astype(np.float32)
