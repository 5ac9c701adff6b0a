"""
Arrays as the text of XML elements: millions of numbers a second, each read back as the same number.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Nine digits tell any two single-precision numbers apart.
_FORMAT = "%.9g"
# Above this share of different numbers a table of them saves nothing.
_WORTH_A_TABLE = 0.5


def number(value: float) -> str:
    """Return one number with nine digits."""
    return _FORMAT % (float(value) + 0.0)


def numbers(values: ArrayLike) -> str:
    """Return some double-precision numbers with nine digits each."""
    return " ".join(map(number, np.ravel(np.asarray(values, float))))


def shortest(value: float) -> float:
    """Return the decimal number with the fewest digits that is the same in single precision."""
    return float(str(np.float32(value)))


def floats(values: ArrayLike) -> str:
    """Return an array of single-precision numbers, row by row; none is changed by being written."""
    flat = np.ascontiguousarray(values, np.float32).ravel() + np.float32(0)  # no -0
    bits, places = np.unique(flat.view(np.uint32), return_inverse=True)
    if len(bits) > _WORTH_A_TABLE * len(flat):
        return " ".join([_FORMAT] * len(flat)) % tuple(flat.tolist())
    words = [_FORMAT.encode() % value for value in bits.view(np.float32).tolist()]
    return _looked_up(words, places)


def indices(values: NDArray[np.integer]) -> str:
    """Return an array of whole numbers from 0, row by row."""
    flat = np.ascontiguousarray(values).ravel()
    if len(flat) == 0:
        return ""
    return _looked_up([b"%d" % value for value in range(int(flat.max()) + 1)], flat)


def _looked_up(words: list[bytes], places: NDArray[np.integer]) -> str:
    """Return words at places; numpy pads them with zero bytes, which then go."""
    table = np.array([word + b" " for word in words])
    return table[places].tobytes().translate(None, b"\0").decode("ascii").rstrip(" ")
