"""Noise as the tolerance: renderings with many seeds, and how far two means are apart in their own error."""

import numpy as np
from scipy import stats

from rtb_addon.spectra import FloatArray

# How often renderers that agree would be called different, were the seeds not fixed.
CHANCE = 1e-4


def in_blocks(radiance: FloatArray, size: int) -> FloatArray:
    """Return the means of blocks of size x size pixels, then of the whole picture: (blocks + 1, bands)."""
    height, width, bands = radiance.shape
    cut = radiance.reshape(height // size, size, width // size, size, bands)
    blocks = cut.mean(axis=(1, 3), dtype=float).reshape(-1, bands)
    return np.vstack([blocks, blocks.mean(axis=0)])


def least_probability(ours: FloatArray, theirs: FloatArray) -> float:
    """
    Return how probable the least probable of the differences of two means is, by chance alone (Welch's t).

    Bonferroni's correction is in it: 1e-4 means that one of all the places and bands differs by what happens
    once in 10 000 such comparisons.

    Parameters
    ----------
    ours, theirs : (seeds, places, bands) arrays, each seed independent of all others
    """
    probabilities = stats.ttest_ind(ours, theirs, axis=0, equal_var=False).pvalue
    return float(np.nanmin(probabilities)) * probabilities.size


def error_of_mean(seeds: FloatArray) -> FloatArray:
    """Return the relative error of the mean over seeds."""
    return seeds.std(axis=0, ddof=1) / np.sqrt(len(seeds)) / seeds.mean(axis=0)
