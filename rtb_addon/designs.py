"""
Experimental designs: the values that a variable takes, as texts for the cells of a table.

numpy alone, as Blender's own process asks for them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np

from .errors import RecipeError
from .spectra import FULL_RANGE, FloatArray, Spectrum
from .spectra.text import format_spectrum

# Joe and Kuo 2008 (new-joe-kuo-6): degree, coefficients, first direction numbers of each further dimension.
_JOE_KUO = (
    (1, 0, (1,)),
    (2, 1, (1, 3)),
    (3, 1, (1, 3, 1)),
    (3, 2, (1, 1, 1)),
    (4, 1, (1, 1, 3, 3)),
    (4, 4, (1, 3, 5, 13)),
    (5, 2, (1, 1, 5, 5, 17)),
    (5, 4, (1, 1, 5, 5, 5)),
    (5, 7, (1, 1, 7, 11, 19)),
)
_BITS = 32
_NUMBER = 6  # significant digits of a number in a cell
_ASSIGNMENT = re.compile(r"\s*([^=]*?)\s*=\s*(.*?)\s*")


def spaced(first: float, last: float, count: int, logarithmic: bool = False) -> list[str]:
    """Return count numbers from first to last, equally far apart or, logarithmic, in equal ratios."""
    if logarithmic and first * last <= 0:
        raise RecipeError("equal ratios need two numbers of one sign, neither of them 0")
    places = (
        np.sign(first) * np.geomspace(abs(first), abs(last), count)
        if logarithmic
        else np.linspace(first, last, count)
    )
    return _texts(places)


def random_numbers(ranges: Sequence[tuple[float, float]], count: int, seed: int) -> list[list[str]]:
    """Return count rows of a uniformly random number within each (low, high)."""
    return _within(ranges, np.random.default_rng(seed).random((count, len(ranges))))


def sobol_numbers(ranges: Sequence[tuple[float, float]], count: int, seed: int) -> list[list[str]]:
    """Return count rows that fill all (low, high) together as evenly as may be."""
    return _within(ranges, sobol(count, len(ranges), seed))


def sobol(count: int, dimensions: int, seed: int) -> FloatArray:
    """
    Return the first points of Sobol's sequence, (count, dimensions) within 0 to 1.

    Notes
    -----
    Each seed shifts all bits of a dimension alike (Owen's random digital shift): 2^k points stay one to each
    elementary interval. At most 10 dimensions.
    """
    if not 1 <= dimensions <= len(_JOE_KUO) + 1:
        raise RecipeError(f"Sobol's sequence has 1 to {len(_JOE_KUO) + 1} variables here, not {dimensions}")
    numbers = np.arange(count, dtype=np.uint64)
    gray = numbers ^ (numbers >> np.uint64(1))
    shift = np.random.default_rng(seed).integers(0, 1 << _BITS, dimensions, dtype=np.uint64)
    columns = []
    for dimension in range(dimensions):
        column = np.full(count, shift[dimension])
        for bit, direction in enumerate(_directions(dimension)):
            column ^= np.where((gray >> np.uint64(bit)) & np.uint64(1), np.uint64(direction), np.uint64(0))
        columns.append((column + 0.5) / (1 << _BITS))
    return np.stack(columns, axis=1)


def graded(first: Spectrum, last: Spectrum, count: int) -> list[str]:
    """Return count spectra from the first to the last as pairs, mixed wavelength by wavelength."""
    places = np.union1d(first.wavelengths, last.wavelengths)
    places = places[(places >= FULL_RANGE[0]) & (places <= FULL_RANGE[1])]
    places = places if len(places) > 1 else np.array(FULL_RANGE)
    mixed = [
        Spectrum(places, _rounded((1 - share) * first.at(places) + share * last.at(places)))
        for share in np.linspace(0, 1, count)
    ]
    return [format_spectrum(each) for each in mixed]


def grid(values: Mapping[str, Sequence[str]]) -> list[list[str]]:
    """Return every combination of the variables' values, the last one varying fastest."""
    return [list(row) for row in product(*values.values())]


def parse_lists(text: str) -> dict[str, list[str]]:
    """Return the values of variables in ``gloss = 0.1, 0.2; paint = D65, A``."""
    return {name: [each.strip() for each in said.split(",")] for name, said in _assignments(text)}


def parse_ranges(text: str) -> dict[str, tuple[float, float]]:
    """Return the low and the high end for each variable in ``gloss = 0 1; distance = 2 5``."""
    found = {}
    for name, said in _assignments(text):
        try:
            low, high = map(float, said.split())
        except ValueError:
            raise RecipeError(f"'{said}' is no range of {name}, write {name} = 0 1") from None
        found[name] = (low, high)
    return found


def _assignments(text: str) -> list[tuple[str, str]]:
    found = []
    for part in filter(str.strip, text.split(";")):
        match = _ASSIGNMENT.fullmatch(part)
        if match is None or not match[1] or not match[2]:
            raise RecipeError(f"'{part.strip()}' says nothing of a variable, write name = ...; name = ...")
        found.append((match[1], match[2]))
    if not found:
        raise RecipeError("no variable is named, write name = ...; name = ...")
    return found


def _directions(dimension: int) -> list[int]:
    """Return the direction numbers of a dimension, the first bit's first."""
    if dimension == 0:
        return [1 << (_BITS - 1 - bit) for bit in range(_BITS)]
    degree, coefficients, starts = _JOE_KUO[dimension - 1]
    found = [start << (_BITS - 1 - bit) for bit, start in enumerate(starts)]
    for bit in range(degree, _BITS):
        direction = found[bit - degree] ^ (found[bit - degree] >> degree)
        for step in range(1, degree):
            if (coefficients >> (degree - 1 - step)) & 1:
                direction ^= found[bit - step]
        found.append(direction)
    return found


def _within(ranges: Sequence[tuple[float, float]], shares: FloatArray) -> list[list[str]]:
    low, high = np.array(ranges, float).T
    return [_texts(row) for row in low + shares * (high - low)]


def _texts(numbers: FloatArray) -> list[str]:
    return [f"{number:.{_NUMBER}g}" for number in numbers.tolist()]


def _rounded(values: FloatArray) -> FloatArray:
    return np.array([float(text) for text in _texts(values)])
