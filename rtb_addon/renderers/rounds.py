"""How many rounds of samples a picture takes, what they come to, and how far they lie apart."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from ..spectra import FloatArray
from .interface import RenderOptions, Report

# More samples of a pixel than this are taken in several rounds where they all are in memory at once.
_MOST_SAMPLES = 256
# Where rounds tell the noise, there are so many at least, of so many samples at most.
_FEWEST_ROUNDS, _FEW_SAMPLES = 4, 64
# Where the clock ends a picture, a round is short.
_QUICK_SAMPLES = 16


class Rounds:
    """
    The mean of independent rounds, and its error.

    Attributes
    ----------
    count : rounds so far
    samples : of a pixel in each
    """

    def __init__(self, samples: int) -> None:
        self.count, self.samples = 0, samples
        self._mean: FloatArray = np.zeros(())
        self._spread: FloatArray = np.zeros(())

    def add(self, found: FloatArray) -> None:
        """Add the mean radiances of a round, of any shape that is always the same; keep them."""
        self.count += 1
        if self.count == 1:
            self._mean = found
            return
        if self.count == 2:
            self._spread = np.zeros_like(found)
        # Welford's way keeps its digits where the spread is small.
        away = found - self._mean
        self._mean += away / self.count
        away *= found - self._mean
        self._spread += away

    def mean(self) -> FloatArray:
        """Return the mean of all rounds."""
        return self._mean

    def error(self) -> FloatArray:
        """Return the standard error of the mean, from the spread of two rounds at least."""
        return np.sqrt(self._spread / (self.count - 1) / self.count)

    def noise(self) -> float:
        """Return the root of the mean squared standard error over the mean; 0 where all is dark."""
        mean = float(self._mean.mean(dtype=float))
        error = float(np.sqrt(np.mean(self._spread, dtype=float) / (self.count - 1) / self.count))
        return error / mean if error else 0.0


class Progress:
    """When a picture of so many rounds is good enough, and how far it is."""

    def __init__(self, count: int, options: RenderOptions, report: Report) -> None:
        self._count, self._options, self._report = count, options, report
        self._began = time.monotonic()
        self._told = 0.0

    def within(self, done: int) -> Callable[[float], None]:
        """Return what tells how far the picture is, from how far the present round is."""
        return lambda fraction: self._tell((done + fraction) / self._count)

    def is_enough(self, rounds: Rounds) -> bool:
        """Return whether no other round is to begin."""
        if rounds.count < 2:
            return False
        late = self._options.seconds is not None and self._passed() >= self._options.seconds
        return late or (self._options.error is not None and rounds.noise() <= self._options.error)

    def _tell(self, fraction: float) -> None:
        if self._options.seconds is not None:
            fraction = min(1.0, max(fraction, self._passed() / self._options.seconds))
        self._told = max(self._told, fraction)
        self._report(self._told)

    def _passed(self) -> float:
        return time.monotonic() - self._began


def tells_noise(options: RenderOptions) -> bool:
    """Return whether the rounds of a picture are to tell its noise."""
    return options.errors or options.error is not None


def rounds_of(samples: int, options: RenderOptions, memory: int = _MOST_SAMPLES) -> tuple[int, int]:
    """
    Return how many rounds a picture takes at most, and how many samples of a pixel each.

    Parameters
    ----------
    memory : how many samples of a pixel a renderer can take in one round
    """
    if options.seconds is not None:
        fewest, most = 2, _QUICK_SAMPLES
    elif tells_noise(options):
        fewest, most = min(_FEWEST_ROUNDS, max(2, samples)), _FEW_SAMPLES
    else:
        fewest, most = 1, memory
    count = max(fewest, -(-samples // most))
    return count, -(-samples // count)
