"""
Random numbers that spread evenly over a pixel's samples.

A (0, 2)-sequence (van der Corput and Sobol), scrambled per pixel and shuffled per use: Kollig and Keller,
*Efficient Multidimensional Sampling*, 2002. They depend on seed, tile, pixel and sample alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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
    Pairs of random numbers for the paths of one tile.

    Parameters
    ----------
    pixels : pixels of the tile
    samples : paths per pixel
    pairs : pairs that a path may ask for
    seed, tile : the same two give the same numbers
    """

    def __init__(self, pixels: int, samples: int, pairs: int, seed: int, tile: int) -> None:
        random = np.random.Generator(np.random.Philox(np.random.SeedSequence([seed % 2**64, tile])))
        points = sequence(samples)
        # Below the digits of the sequence each sample has digits of its own, or a pixel's samples would share
        # them, and with them whatever the last digits decide.
        free = 32 - max(samples - 1, 1).bit_length()
        below = random.integers(0, 1 << free, (pairs, 2, samples), np.uint32)
        self._points = [points[:, random.permutation(samples)] ^ below[pair] for pair in range(pairs)]
        self._scramble = random.integers(0, 1 << 32, (pairs, 2, pixels), np.uint32)

    def pair(self, use: int, pixel: NDArray, sample: NDArray) -> tuple[FloatArray, FloatArray]:
        """Return two (n,) arrays in [0, 1): the numbers for some use of some samples of some pixels."""
        u, v = self._points[use].take(sample, axis=1) ^ self._scramble[use].take(pixel, axis=1)
        return u * 2.0**-32, v * 2.0**-32
