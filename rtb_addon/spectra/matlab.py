"""Plain arrays out of MATLAB files, as the Psychophysics Toolbox keeps its spectra in (levels 4 and 5)."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import RecipeError

_HEADER = 128  # of level 5 [bytes]
_HDF5 = b"\x89HDF"
_MATRIX, _COMPRESSED = 14, 15
_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
_LEVEL_4 = {0: "f8", 1: "f4", 2: "i4", 3: "i2", 4: "u2", 5: "u1"}
_NUMBERS = range(6, 16)  # classes of arrays that hold numbers: double, single, and integers
_COMPLEX = 0x08


def read_arrays(path: Path) -> dict[str, NDArray]:
    """Return the real arrays of numbers in a ``.mat`` file by name, two-dimensional; others are left out."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read {path}: {error.strerror}") from error
    if _HDF5 in content[: 2 * _HEADER] or content[124:126] == b"\x00\x02":
        raise RecipeError("is of version 7.3, save it with MATLAB's option -v7", path)
    try:
        level_5 = content[126:128] in (b"IM", b"MI")
        return dict(_level_5(content) if level_5 else _level_4(content))
    except (struct.error, ValueError, KeyError, IndexError, UnicodeDecodeError, zlib.error) as error:
        raise RecipeError("is damaged, or no MATLAB file", path) from error


def _level_5(content: bytes) -> Iterator[tuple[str, NDArray]]:
    order = "<" if content[126:128] == b"IM" else ">"
    for kind, data in _elements(content[_HEADER:], order):
        if kind == _COMPRESSED:
            ((kind, data),) = _elements(zlib.decompress(data), order)
        if kind == _MATRIX and (found := _matrix(data, order)) is not None:
            yield found


def _elements(content: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Yield the type and the bytes of each element; small ones share their tag's eight bytes."""
    place = 0
    while place + 8 <= len(content):
        kind, size = struct.unpack_from(f"{order}II", content, place)
        if kind >> 16:
            kind, size, begin, end = kind & 0xFFFF, kind >> 16, place + 4, place + 8
        else:
            begin = place + 8
            end = begin + (size if kind == _COMPRESSED else -(-size // 8) * 8)
        if begin + size > len(content):
            raise ValueError("an element ends beyond the file")
        yield kind, content[begin : begin + size]
        place = end


def _matrix(data: bytes, order: str) -> tuple[str, NDArray] | None:
    """Return the name and the numbers of a matrix, None for one that holds anything else."""
    parts = _elements(data, order)
    _, flags = next(parts)
    word = struct.unpack_from(f"{order}I", flags)[0]
    if (word & 0xFF) not in _NUMBERS or (word >> 8) & _COMPLEX:
        return None
    _, sizes = next(parts)
    shape = np.frombuffer(sizes, f"{order}i4")
    _, name = next(parts)
    kind, numbers = next(parts)
    if len(shape) != 2:
        return None
    values = np.frombuffer(numbers, f"{order}{_TYPES[kind]}").astype(float)
    return name.decode("ascii"), values.reshape(tuple(shape), order="F")


def _level_4(content: bytes) -> Iterator[tuple[str, NDArray]]:
    place = 0
    while place < len(content):
        order = "<" if struct.unpack_from("<I", content, place)[0] < 5000 else ">"
        kind, rows, columns, imaginary, length = struct.unpack_from(f"{order}5I", content, place)
        machine, _, precision, text = kind // 1000, kind // 100 % 10, kind // 10 % 10, kind % 10
        if machine > 1 or not 0 < length < 64:
            raise ValueError("no MATLAB file")
        name = content[place + 20 : place + 20 + length].rstrip(b"\0").decode("ascii")
        numbers = np.dtype(f"{order}{_LEVEL_4[precision]}")
        begin, count = place + 20 + length, rows * columns
        place = begin + count * numbers.itemsize * (2 if imaginary else 1)
        if place > len(content):
            raise ValueError("an array ends beyond the file")
        if not text and not imaginary:
            values = np.frombuffer(content, numbers, count, begin).astype(float)
            yield name, values.reshape((rows, columns), order="F")
