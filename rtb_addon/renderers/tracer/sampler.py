"""
Random numbers that spread evenly over a pixel's samples.

A (0, 2)-sequence (van der Corput and Sobol), scrambled per pixel and shuffled per use: Kollig and Keller,
*Efficient Multidimensional Sampling*, 2002. They depend on seed, round, pixel and sample alone: not on which
other pixels are rendered, and by whom.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...scene.render_scene import IntArray
from ...spectra import FloatArray


def sequence(count: int) -> NDArray[np.uint32]:
    """
    Return the first points of the (0, 2)-sequence as (2, count) fractions of 2**32.

    Any 2**k points that follow each other have one in each box of area 2**-k.
    """
    index = np.arange(count, dtype=np.uint32)
    points = np.zeros((2, count), np.uint32)
    corput = sobol = np.uint32(1 << 31)
    for bit in range(max(count - 1, 1).bit_length()):
        on = (index >> np.uint32(bit)) & np.uint32(1)
        points ^= on * np.array([[corput], [sobol]])
        corput, sobol = corput >> np.uint32(1), sobol ^ (sobol >> np.uint32(1))
    return points


class Sampler:
    """
    Pairs of random numbers for the paths of some pixels.

    Parameters
    ----------
    pixels : (pixels,) int array, their numbers in the whole picture
    samples : paths per pixel
    pairs : pairs that a path may ask for
    seed, number : of the picture, and of its round; others are independent

    Attributes
    ----------
    turns : (pixels,) int array, any numbers
    """

    def __init__(self, pixels: IntArray, samples: int, pairs: int, seed: int, number: int) -> None:
        uses = [_use(samples, seed % 2**64, number, use) for use in range(pairs)]
        self._points = [points for points, _ in uses]
        self._scramble = _bits(pixels, np.stack([keys for _, keys in uses]))
        self.turns = _bits(pixels, np.uint64(seed % 2**64 ^ number)).astype(int)

    def pair(self, use: int, pixel: NDArray, sample: NDArray) -> tuple[FloatArray, FloatArray]:
        """Return two (n,) arrays in [0, 1): the numbers for some use of some samples of some pixels."""
        u, v = self._points[use].take(sample, axis=1) ^ self._scramble[use].take(pixel, axis=1)
        return u * 2.0**-32, v * 2.0**-32


@lru_cache(maxsize=64)
def _use(samples: int, seed: int, number: int, use: int) -> tuple[NDArray[np.uint32], NDArray[np.uint64]]:
    """Return the (2, samples) points of one use in a round, as fractions of 2**32, and (2, 1) keys."""
    random = np.random.Generator(np.random.Philox(np.random.SeedSequence([seed, number, use])))
    points = sequence(samples)[:, random.permutation(samples)]
    # Below the digits of the sequence each sample has digits of its own, or a pixel's samples would share
    # them, and with them whatever the last digits decide.
    last = 1 << 32 - max(samples - 1, 1).bit_length()
    below = random.integers(0, last, points.shape, np.uint32)
    return points ^ below, random.integers(0, 1 << 64, (2, 1), np.uint64)


def _bits(numbers: IntArray, key: NDArray[np.uint64] | np.uint64) -> NDArray[np.uint32]:
    """Return 32 bits for each number and key that nothing else has to do with (SplitMix64)."""
    x = (numbers.astype(np.uint64) + key) * np.uint64(0x9E3779B97F4A7C15)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        x = (x ^ (x >> np.uint64(shift))) * np.uint64(factor)
    return ((x ^ (x >> np.uint64(31))) >> np.uint64(32)).astype(np.uint32)
