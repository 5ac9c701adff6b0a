"""Cubes that were looked at last, and what was seen of them, as long as their files stay as they are."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .errors import RecipeError
from .layers import ERROR, Layers
from .probing import brightest
from .spectral_image import SpectralImage
from .views import View, reduced

MEMORY = 500_000_000  # of cubes that are kept [bytes]


@dataclass(frozen=True)
class Source:
    """
    What a picture of a condition is made of.

    Parameters
    ----------
    file : the condition's cube
    other : the cube that differences are to
    layers : the file that holds standard errors
    """

    file: Path
    other: Path | None = None
    layers: Path | None = None

    @property
    def stamp(self) -> tuple[int, ...]:
        """When its files were written, 0 for those that are not there."""
        files = (self.file, self.other, self.layers)
        return tuple(_stamp(each) for each in files if each is not None)


class Part(NamedTuple):
    """What is to be seen of a cube, and how high and wide the cube is [pixels]."""

    pixels: np.ndarray
    size: tuple[int, int]


class KeptCubes:
    """Reads cubes once, and finds out once what is to be seen of them."""

    def __init__(self) -> None:
        self._cubes: dict[Path, tuple[int, SpectralImage]] = {}
        self._bytes = 0
        self._way: tuple[View, int] | None = None  # in which the parts are seen
        self._parts: dict[Source, tuple[tuple[int, ...], Part]] = {}
        self._brightest: dict[Path, tuple[int, float]] = {}

    def cube(self, file: Path) -> SpectralImage:
        """Return a cube; a file that is not there yet raises."""
        if not (stamp := _stamp(file)):
            raise RecipeError(f"{file.stem} is not rendered yet, press Render Recipe")
        known = self._forget(file)
        if known is None or known[0] != stamp:
            known = stamp, SpectralImage.load(file)
        self._cubes[file] = known
        self._bytes += known[1].radiance.nbytes
        while len(self._cubes) > 1 and self._bytes > MEMORY:
            self._forget(next(iter(self._cubes)))
        return known[1]

    def _forget(self, file: Path) -> tuple[int, SpectralImage] | None:
        known = self._cubes.pop(file, None)
        self._bytes -= 0 if known is None else known[1].radiance.nbytes
        return known

    def brightest(self, file: Path) -> float:
        """Return the luminance of a cube's brightest pixel [cd m-2]."""
        cube, stamp = self.cube(file), self._cubes[file][0]
        if self._brightest.get(file, (0, 0.0))[0] != stamp:
            self._brightest[file] = stamp, brightest(cube)
        return self._brightest[file][1]

    def part(self, source: Source, view: View, by: int) -> Part:
        """Return what is to be seen of a cube, of so many pixels across and down their mean."""
        if self._way != (way := (replace(view, full=None), by)):
            self._way = way
            self._parts.clear()
        stamp = source.stamp
        if source not in self._parts or self._parts[source][0] != stamp:
            self._parts[source] = stamp, self._seen(source, view, by)
        return self._parts[source][1]

    def _seen(self, source: Source, view: View, by: int) -> Part:
        cube = self.cube(source.file)
        other = None if source.other is None else self.cube(source.other)
        error = None if source.layers is None else _standard_error(source)
        height, width, _ = cube.radiance.shape
        return Part(reduced(view.of(cube, other, error), by), (height, width))


def _standard_error(source: Source) -> np.ndarray:
    """Return the standard errors of a cube, (height, width, bands) [W sr-1 m-2 nm-1]."""
    assert source.layers is not None
    planes = Layers.load(source.layers).planes if source.layers.is_file() else {}
    if ERROR not in planes:
        raise RecipeError(
            f"{source.file.stem} has no standard errors: ask for them under Layers, in the render settings, "
            "and render it again"
        )
    return planes[ERROR]


def _stamp(file: Path) -> int:
    """Return when a file was written, 0 when it is not there."""
    try:
        return file.stat().st_mtime_ns
    except OSError:
        return 0
