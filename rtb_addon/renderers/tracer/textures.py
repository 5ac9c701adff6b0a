"""Spectra that vary over a surface: pictures and checkerboards, looked up by texture coordinates."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ...scene.render_scene import Film, IntArray, Texture
from ...spectra import FloatArray
from ..pictures import read_picture
from .tables import Lookup, table


class Checkerboard:
    """A board of two spectra; the check at the origin is even."""

    def __init__(self, texture: Texture, film: Film) -> None:
        said = texture.parameters
        named = [(f"{name} of texture {texture.id}", said[name]) for name in ("evenColor", "oddColor")]
        self._colours = table(named, film)
        self._place = pairs_of(texture, "checksPer", "offset") / [[2], [1]]

    def at(self, uvs: FloatArray) -> FloatArray:
        """Return the spectrum of each check."""
        first, second = (uvs * self._place[0, :, None] + self._place[1, :, None]) % 1 > 0.5
        return self._colours.take((first != second).astype(int), axis=0)


class Bitmap:
    """A picture, of colours or of spectra (see pictures.py); V grows upwards, texels are their middles."""

    def __init__(self, texture: Texture, film: Film) -> None:
        said = texture.parameters
        picture = read_picture(Path(str(said["filename"])), float(said["gamma"]))  # type: ignore[arg-type]
        self._texels = picture.texels.reshape(-1, picture.texels.shape[2])
        self._height, self._width, _ = picture.texels.shape
        self._weights = picture.weights(film.bands, film.band_kind).astype(np.float32)
        self._nearest, self._wraps = said["filterMode"] == "nearest", (str(said["wrapMode"]),) * 2
        self._place = pairs_of(texture, "scale", "offset")

    def at(self, uvs: FloatArray) -> FloatArray:
        """Return the texel at each place, or what the four around it are on average."""
        u, v = uvs * self._place[0, :, None] + self._place[1, :, None]
        places = u * self._width, (1 - v) * self._height
        mixed = np.zeros((len(u), self._texels.shape[1]), np.float32)
        for number, share in around(places, (self._width, self._height), self._wraps, self._nearest):
            mixed += self._texels.take(number, axis=0) * share[:, None]
        return mixed @ self._weights


def around(
    places: Sequence[FloatArray], sizes: Sequence[int], wraps: Sequence[str], nearest: bool = False
) -> Iterator[tuple[IntArray, FloatArray]]:
    """
    Yield the four texels around each place, and how much each counts.

    Parameters
    ----------
    places : in texels from the left and from the top
    sizes : width and height of the picture
    wraps : how it goes on across and down
    nearest : whether only the nearest of the four counts
    """
    across, down = (beside(*one, nearest) for one in zip(places, sizes, wraps, strict=True))
    for row, low in down:
        for column, along in across:
            yield row * sizes[0] + column, low * along


def beside(
    place: FloatArray, count: int, wrap: str, nearest: bool = False
) -> list[tuple[IntArray, FloatArray]]:
    """Return the two texels that places lie between in one direction, and how much each counts."""
    middle = place - 0.5
    low: FloatArray = np.floor(middle)
    share: FloatArray = (middle - low).astype(np.float32)
    if nearest:
        share = (share >= 0.5).astype(np.float32)
    return [(_wrapped(low, count, wrap), 1 - share), (_wrapped(low + 1, count, wrap), share)]


def _wrapped(place: FloatArray, count: int, wrap: str) -> IntArray:
    """Return the number of a texel that may lie outside the picture."""
    if wrap == "repeat":
        return (place % count).astype(int)
    if wrap == "mirror":
        again = place % (2 * count)
        return np.minimum(again, 2 * count - 1 - again).astype(int)
    return place.clip(0, count - 1).astype(int)


KINDS = {"checkerboard": Checkerboard, "bitmap": Bitmap}


def lookup(texture: Texture, film: Film) -> Lookup:
    """Return a texture ready to be asked for the bands of a film."""
    return KINDS[texture.kind](texture, film)


def pairs_of(texture: Texture, scale: str, offset: str) -> FloatArray:
    """Return how texture coordinates are scaled, then moved: a row each, a column for U and V."""
    said = texture.parameters
    return np.array([[said[f"{name}{axis}"] for axis in "UV"] for name in (scale, offset)], float)
