"""OpenEXR files as a header of texts and named planes of pixels."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from .errors import RecipeError
from .files import replacing
from .spectra import FloatArray

_MAGIC, _TILED_DEEP_OR_MULTIPART = 20000630, 0x1A00


def write_exr(path: Path, header: Mapping[str, Any], planes: Mapping[str, FloatArray]) -> None:
    """
    Write planes of pixels without loss, whole or not at all.

    Parameters
    ----------
    header : attributes, texts mostly
    planes : channel name -> (height, width) float32 array, row 0 on top
    """
    import OpenEXR

    # Noise hardly compresses: ZIP makes files a sixth smaller and takes five times as long to write them.
    header = {"compression": OpenEXR.RLE_COMPRESSION, "type": OpenEXR.scanlineimage, **header}
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
    """
    Return whether a file is OpenEXR and reaches as far as its own table of lines says.

    Notes
    -----
    The library would tell too, but prints its opinion where a reader of our output does not expect it.
    Of tiled, deep and multi-part files only the beginning is looked at.
    """
    with path.open("rb") as file:
        magic, version = struct.unpack("<II", file.read(8).ljust(8, b"\0"))
        if magic != _MAGIC or not _skip_attributes(file):
            return False
        return bool(version & _TILED_DEEP_OR_MULTIPART) or _reaches_last_line(file, path.stat().st_size)


def _skip_attributes(file: BinaryIO) -> bool:
    """Move to the end of the header, each attribute of which is a name, a type, a size and its bytes."""
    while (name := _word(file)) != b"\0":
        _word(file)
        size = file.read(4)
        if not name or len(size) < 4:
            return False
        file.seek(struct.unpack("<I", size)[0], 1)
    return True


def _word(file: BinaryIO) -> bytes:
    """Return the bytes up to and with the next zero, fewer at the file's end."""
    word = bytearray()
    while byte := file.read(1):
        word += byte
        if byte == b"\0":
            break
    return bytes(word)


def _reaches_last_line(file: BinaryIO, size: int) -> bool:
    """Return whether the last block of lines, as the table after the header places it, ends inside."""
    table = file.tell()
    first = struct.unpack("<Q", file.read(8).ljust(8, b"\0"))[0]
    if not table < first < size:
        return False
    file.seek(table)
    places = np.frombuffer(file.read(first - table), "<u8")
    last = int(places.max())
    file.seek(last + 4)  # after the number of its first line
    length = file.read(4)
    return places.min() > 0 and len(length) == 4 and last + 8 + struct.unpack("<I", length)[0] <= size
