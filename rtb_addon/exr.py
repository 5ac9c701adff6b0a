"""OpenEXR files as a header of texts and named planes of pixels."""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from .errors import RecipeError
from .files import replacing
from .spectra import FloatArray

_MAGIC, _TILED_DEEP_OR_MULTIPART = 20000630, 0x1A00
_LONGEST_HEADER = 16 << 20  # [bytes]
_DULL = 0.1  # of all numbers are nothing, from which on compression pays


def write_exr(path: Path, header: Mapping[str, Any], planes: Mapping[str, FloatArray]) -> None:
    """
    Write planes of pixels without loss, whole or not at all.

    Parameters
    ----------
    header : attributes, texts mostly
    planes : channel name -> (height, width) float32 array, row 0 on top
    """
    import OpenEXR

    # Noise hardly compresses: ZIP makes files a sixth smaller and takes ten times as long to write them.
    lit = sum(map(np.count_nonzero, planes.values()))
    pays = lit < (1 - _DULL) * sum(plane.size for plane in planes.values())
    method = OpenEXR.RLE_COMPRESSION if pays else OpenEXR.NO_COMPRESSION
    header = {"compression": method, "type": OpenEXR.scanlineimage, **header}
    with replacing(path) as temporary:
        try:
            # OpenEXR reads a view with gaps as if it had none.
            whole = {name: np.ascontiguousarray(plane) for name, plane in planes.items()}
            OpenEXR.File(header, whole).write(str(temporary))
        except RuntimeError as error:
            raise RecipeError(f"cannot write {path.name} into {path.parent}: {error}") from error


def read_exr(path: Path) -> tuple[dict[str, Any], dict[str, FloatArray]]:
    """Return the attributes of a file and its channels, each a (height, width) array."""
    import OpenEXR

    if not path.is_file():
        raise RecipeError(f"there is no file {path}")
    try:
        if not is_whole(path):
            raise ValueError("truncated")
        with OpenEXR.File(str(path), separate_channels=True) as file:
            planes = {name: channel.pixels for name, channel in file.channels().items()}
            return dict(file.header()), planes  # a copy: closing the file empties its own
    except OSError as error:
        raise RecipeError(f"cannot read {path}: {error.strerror}") from error
    except (RuntimeError, ValueError) as error:
        raise RecipeError("not a whole OpenEXR file, was it cut off or is it something else", path) from error


def is_whole(path: Path) -> bool:
    """Return whether a file is OpenEXR and reaches as far as its own table of lines says."""
    return texts_of_whole(path) is not None


def texts_of_whole(path: Path) -> dict[str, str] | None:
    """
    Return a file's text attributes, None where it is not OpenEXR or ends too early.

    Notes
    -----
    The library would tell too, but takes ten times as long, and prints its opinion where a reader of our
    output does not expect it. Of tiled, deep and multi-part files only the beginning is looked at.
    """
    with path.open("rb") as file:
        magic, version = struct.unpack("<II", file.read(8).ljust(8, b"\0"))
        if magic != _MAGIC or (header := _read_header(file)) is None:
            return None
        attributes, table = header
        if not version & _TILED_DEEP_OR_MULTIPART and not _reaches_last_line(file, table):
            return None
    return {
        name.decode(): value.decode(errors="replace")
        for (name, kind), value in attributes.items()
        if kind == b"string"
    }


_Attributes = dict[tuple[bytes, bytes], bytes]


def _read_header(file: BinaryIO) -> tuple[_Attributes, int] | None:
    """Return attributes by name and type, and where the header ends; None where it does not."""
    size, start = 1 << 14, file.tell()
    while True:
        file.seek(start)
        content = file.read(size)
        if (found := _attributes(content)) is not None:
            return found[0], start + found[1]
        if len(content) < size or size > _LONGEST_HEADER:
            return None
        size *= 8


def _attributes(content: bytes) -> tuple[_Attributes, int] | None:
    """Return what a header holds, each a name, a type, a size and its bytes, up to an empty name."""
    found, place = {}, 0
    while content[place : place + 1] != b"\0":
        named = content.find(b"\0", place)
        typed = content.find(b"\0", named + 1)
        begin = typed + 5
        end = begin + int.from_bytes(content[typed + 1 : begin], "little")
        if not place < named < typed or end >= len(content):
            return None
        found[content[place:named], content[named + 1 : typed]] = content[begin:end]
        place = end
    return found, place + 1


def _reaches_last_line(file: BinaryIO, table: int) -> bool:
    """Return whether the last block of lines, as the table after the header places it, ends inside."""
    size = file.seek(0, os.SEEK_END)
    file.seek(table)
    first = struct.unpack("<Q", file.read(8).ljust(8, b"\0"))[0]
    if not table < first < size:
        return False
    file.seek(table)
    places = np.frombuffer(file.read(first - table), "<u8")
    last = int(places.max())
    file.seek(last + 4)  # after the number of its first line
    length = file.read(4)
    return places.min() > 0 and len(length) == 4 and last + 8 + struct.unpack("<I", length)[0] <= size
