"""Arrays as the text of XML elements: millions of numbers a second, each read back as the same."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Nine digits tell any two single-precision numbers apart.
_DIGITS = 9
_FORMAT = f"%.{_DIGITS}g"
# Above this share of different numbers a table of them saves nothing.
_WORTH_A_TABLE = 0.5
# Powers of ten of the leading digit of numbers that are written without an exponent, twelve decimals at most.
_PLAIN = range(-4, 7)
# What makes a number of a power of ten a whole one of nine digits; negative powers count from the end.
_SCALES = 10.0 ** (_DIGITS - 1 - np.concatenate([np.arange(0, 40), np.arange(-50, 0)]))
# What that whole number is to be multiplied by, to count in the twelfth decimal, and what it has for each 1.
_SHIFTS = np.array([10 ** (power + 4) if power in _PLAIN else 0 for power in [*range(40), *range(-50, 0)]])
_ONES = np.array([10 ** max(_DIGITS - 1 - power, 0) for power in range(40)])


def _letters(words: Iterable[bytes]) -> NDArray[np.uint32]:
    """Return words of up to four letters, four bytes each."""
    return np.array(list(words), "S4").view(np.uint32)


_SIGNED = _letters(sign + word for sign in (b"", b"-") for word in [*(b"%d" % k for k in range(1000)), b""])
_LEADING = _letters(b"%d" % k for k in range(10_000))
# Without and with zeros at their end, which the second half leaves out.
_FOURS = _letters(
    [*(b"%04d" % k for k in range(10_000)), *((b"%04d" % k).rstrip(b"0") for k in range(10_000))]
)
_POINTED = _letters(
    [*(b".%03d" % k for k in range(1000)), *((b".%03d" % k).rstrip(b"0").rstrip(b".") for k in range(1000))]
)
_LAST = _letters(b"%d " % k if k else b" " for k in range(10))
_FEW = 1000
# Numbers at a time: what is done to them then stays in the processor's cache.
_CHUNK = 1 << 15


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
    # Numpy moves numbers faster than letters.
    words = table.view(np.uint64) if table.dtype.itemsize == 8 else table
    pieces = (places[start : start + _CHUNK] for start in range(0, len(places), _CHUNK))
    return b"".join(words.take(piece).tobytes().translate(None, b"\0") for piece in pieces)[:-1]


def _whole_numbers(count: int) -> NDArray[np.bytes_]:
    """(count,) array: 0, 1, 2 ... as words, each with its blank"""
    width = max(len(str(count - 1)), 7)
    text = np.zeros((count, width + 1), np.uint8)
    for length in range(1, len(str(count - 1)) + 1):
        first, end = 10 ** (length - 1) if length > 1 else 0, min(10**length, count)
        rows = np.arange(first, end)
        for column in range(length):
            text[first:end, column] = rows // 10 ** (length - 1 - column) % 10 + ord("0")
        text[first:end, length] = ord(" ")
    return text.reshape(-1).view(f"S{width + 1}")


def _in_digits(values: NDArray[np.float32]) -> bytes:
    """Return numbers as %.9g writes them, all at once; zero bytes between their letters go at the end."""
    sizes, negative = np.abs(values.astype(float)), values < 0
    whole, powers = _in_nine_digits(sizes)
    decimals, parts = whole * _SHIFTS.take(powers), np.zeros(len(whole), np.int64)
    if (large := np.flatnonzero((powers >= 0) & (powers <= _PLAIN[-1]))).size:
        ones = _ONES[powers[large]]
        parts[large] = whole[large] // ones
        decimals[large] -= parts[large] * ones * _SHIFTS[powers[large]]
    words = np.stack([*_whole_part(parts, negative), *_decimal_part(decimals)], axis=1)
    if (odd := np.flatnonzero((powers < _PLAIN[0]) | (powers > _PLAIN[-1]))).size:
        words[odd] = _one_by_one(values[odd], words.shape[1])
    return words.tobytes().translate(None, b"\0")


def _in_nine_digits(sizes: NDArray[np.floating]) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Return sizes as whole numbers of nine digits, and the powers of ten of their leading digits."""
    powers = np.floor(np.log10(np.where(sizes > 0, sizes, 1.0).astype(np.float32))).astype(np.int32)
    whole = np.rint(sizes * _SCALES.take(powers)).astype(np.int64)
    over = whole >= 10**_DIGITS  # 9.9999999996 is 10 then, or the logarithm was rounded down
    powers[over] += 1
    whole[over] = np.rint(sizes[over] * _SCALES[powers[over]]).astype(np.int64)
    under = (whole < 10 ** (_DIGITS - 1)) & (sizes > 0)  # the logarithm was rounded up
    powers[under] -= 1
    whole[under] = np.rint(sizes[under] * _SCALES[powers[under]]).astype(np.int64)
    return whole, powers


def _whole_part(parts: NDArray[np.int64], negative: NDArray[np.bool_]) -> list[NDArray[np.uint32]]:
    """Return signs and what stands before the point, in four letters each."""
    signed = negative * 1001
    if int(parts.max()) < 1000:
        return [_SIGNED.take(signed + parts)]
    upper, lower = _split(parts, 10_000)
    letters = np.where(upper, _FOURS.take(lower), _LEADING.take(lower))
    return [_SIGNED.take(signed + np.where(upper, upper, 1000)), letters]


def _decimal_part(decimals: NDArray[np.int64]) -> list[NDArray[np.uint32]]:
    """Return twelve decimals with their point and a blank, in four letters each, without zeros at the end."""
    front, rest = _split(decimals, 10**9)
    middle, rest = _split(rest, 10**5)
    back, last = _split(rest, 10)
    ends = last == 0
    words = [_LAST.take(last), _FOURS.take(back + 10_000 * ends)]
    ends &= back == 0
    words.append(_FOURS.take(middle + 10_000 * ends))
    ends &= middle == 0
    words.append(_POINTED.take(front + 1000 * ends))
    return words[::-1]


def _split(values: NDArray[np.int64], unit: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return how often a unit is in values and what is left, in a third of divmod's time."""
    upper = values // unit
    return upper, values - upper * unit


def _one_by_one(values: NDArray[np.float32], width: int) -> NDArray[np.uint32]:
    """Return numbers that need an exponent, or are very large, each as Python writes it, and a blank."""
    words = [_FORMAT.encode() % value + b" " for value in values.tolist()]
    return np.frombuffer(b"".join(word.ljust(4 * width, b"\0") for word in words), np.uint32).reshape(
        -1, width
    )
