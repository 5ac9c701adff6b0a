"""Arrays as the text of XML elements: millions of numbers a second, each read back as the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Nine digits tell any two single-precision numbers apart.
_DIGITS = 9
_FORMAT = f"%.{_DIGITS}g"
# Above this share of different numbers a table of them saves nothing.
_WORTH_A_TABLE = 0.5
# Powers of ten that the leading digit may stand for where no exponent is written.
_PLAIN = range(-4, _DIGITS)
# What makes a number of a power of ten a whole one of nine digits; negative powers count from the end.
_SCALES = 10.0 ** (_DIGITS - 1 - np.concatenate([np.arange(0, 40), np.arange(-50, 0)]))
_WIDTH = len("-0.000") + _DIGITS + len(" ")
_TRIPLES = np.array([b"%03d" % value for value in range(1000)])
_FEW = 1000
# Numbers at a time: what is done to them then stays in the processor's cache.
_CHUNK = 1 << 14


def number(value: float) -> str:
    """Return one number with nine digits."""
    return _FORMAT % (float(value) + 0.0)


def numbers(values: ArrayLike) -> str:
    """Return some double-precision numbers with nine digits each."""
    return " ".join(map(number, np.ravel(np.asarray(values, float))))


def shortest(value: float) -> float:
    """Return the decimal number with the fewest digits that is the same in single precision."""
    # str() would follow the print options, which other libraries change.
    return float(np.format_float_scientific(np.float32(value), unique=True))


def floats(values: ArrayLike) -> bytes:
    """Return an array of single-precision numbers, row by row; none is changed by being written."""
    flat = np.ascontiguousarray(values, np.float32).ravel() + np.float32(0)  # no -0
    if len(flat) < _FEW:
        return b" ".join(_FORMAT.encode() % value for value in flat.tolist())
    some = flat[:: len(flat) // _FEW].view(np.uint32)
    if len(np.unique(some)) > _WORTH_A_TABLE * len(some):
        chunks = range(0, len(flat), _CHUNK)
        return b"".join(_in_digits(flat[start : start + _CHUNK]) for start in chunks)[:-1]
    bits, places = np.unique(flat.view(np.uint32), return_inverse=True)
    words = [_FORMAT.encode() % value + b" " for value in bits.view(np.float32).tolist()]
    return _looked_up(np.array(words), places)


def indices(values: NDArray[np.integer]) -> bytes:
    """Return an array of whole numbers from 0, row by row."""
    flat = np.ascontiguousarray(values).ravel()
    if len(flat) == 0:
        return b""
    return _looked_up(_whole_numbers(int(flat.max()) + 1), flat)


def _looked_up(table: NDArray[np.bytes_], places: NDArray[np.integer]) -> bytes:
    """Return words, each with its blank, at places; numpy pads them with zero bytes, which then go."""
    return table[places].tobytes().translate(None, b"\0")[:-1]


def _whole_numbers(count: int) -> NDArray[np.bytes_]:
    """(count,) array: 0, 1, 2 ... as words, each with its blank"""
    width = len(str(count - 1))
    text = np.zeros((count, width + 1), np.uint8)
    for length in range(1, width + 1):
        first, end = 10 ** (length - 1) if length > 1 else 0, min(10**length, count)
        rows = np.arange(first, end)
        for column in range(length):
            text[first:end, column] = rows // 10 ** (length - 1 - column) % 10 + ord("0")
        text[first:end, length] = ord(" ")
    return text.reshape(-1).view(f"S{width + 1}")


def _in_digits(values: NDArray[np.float32]) -> bytes:
    """Return numbers as %.9g writes them, all at once: the digits first, then the point among them."""
    sizes = np.abs(values.astype(float))
    powers = np.floor(np.log10(np.where(sizes > 0, sizes, 1.0).astype(np.float32))).astype(np.int32)
    whole = np.rint(sizes * _SCALES[powers]).astype(np.int64)
    over = whole >= 10**_DIGITS  # 9.9999999996 is 10 then, or the logarithm was rounded down
    powers[over] += 1
    whole[over] = np.rint(sizes[over] * _SCALES[powers[over]]).astype(np.int64)
    under = (whole < 10 ** (_DIGITS - 1)) & (sizes > 0)  # the logarithm was rounded up
    powers[under] -= 1
    whole[under] = np.rint(sizes[under] * _SCALES[powers[under]]).astype(np.int64)
    digits = _digits(whole.astype(np.int32))
    text = np.zeros((len(values), _WIDTH), np.uint8)
    text[:, 0] = np.where(values < 0, ord("-"), 0)
    for power in _different(powers):
        rows = np.flatnonzero(powers == power)
        text[rows, 1:] = _laid_out(digits[rows], power) if power in _PLAIN else _one_by_one(sizes[rows])
    return text.tobytes().translate(None, b"\0")


def _different(powers: NDArray[np.integer]) -> list[int]:
    lowest = int(powers.min())
    return (np.flatnonzero(np.bincount(powers - lowest)) + lowest).tolist()


def _digits(whole: NDArray[np.int32]) -> NDArray[np.uint8]:
    """(numbers, 9) array: the decimal digits as characters"""
    triples = np.empty((len(whole), 3), _TRIPLES.dtype)
    upper, lower = np.divmod(whole, 1000)
    top, middle = np.divmod(upper, 1000)
    for place, part in enumerate((top, middle, lower)):
        triples[:, place] = _TRIPLES[part]
    return triples.view(np.uint8).reshape(-1, _DIGITS)


def _laid_out(digits: NDArray[np.uint8], power: int) -> NDArray[np.uint8]:
    """Return digits with their point and a blank behind them; zeros at the end become zero bytes."""
    before = max(power + 1, 0)
    whole = _trimmed(digits, before)
    lead = b"" if power >= 0 else b"0." + b"0" * (-power - 1)
    text = np.zeros((len(digits), _WIDTH - 1), np.uint8)
    text[:, : len(lead)] = np.frombuffer(lead, np.uint8)
    text[:, len(lead) : len(lead) + before] = digits[:, :before]
    after = len(lead) + before
    if 0 < before < _DIGITS:
        text[:, after] = ord(".")
        text[whole, after] = 0
        after += 1
    text[:, after : after + _DIGITS - before] = digits[:, before:]
    text[:, -1] = ord(" ")
    return text


def _trimmed(digits: NDArray[np.uint8], before: int) -> NDArray[np.integer]:
    """Make the last zeros behind the point zero bytes, and return the rows that have nothing else there."""
    rows = np.arange(len(digits))
    for column in range(_DIGITS - 1, before - 1, -1):
        rows = rows[digits[rows, column] == ord("0")]
        digits[rows, column] = 0
    return rows


def _one_by_one(sizes: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return numbers that need an exponent, each as Python writes it, and a blank."""
    words = [(_FORMAT % size).encode().ljust(_WIDTH - 2, b"\0") + b" " for size in sizes.tolist()]
    return np.frombuffer(b"".join(words), np.uint8).reshape(-1, _WIDTH - 1)
