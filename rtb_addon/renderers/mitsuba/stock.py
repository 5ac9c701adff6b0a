"""
The slow way out where no LLVM works: Mitsuba's stock path and spectral film, in its scalar variant.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import mitsuba as mi
import numpy as np

from ..interface import RenderOptions, Report
from ..rounds import Progress, Rounds, rounds_of
from .native import Native

# Paths of a round: some tenths of a second.
_PATHS = 2**17


def render_stock(scene: mi.Scene, native: Native, options: RenderOptions, report: Report) -> Rounds:
    """Return the rounds of a picture, as many as its samples or the options want."""
    count, each = rounds_of(native.samples, options)
    most = max(1, _PATHS // (native.part.width * native.part.height))
    if each > most:
        count, each = -(-native.samples // most), most
    sampler = scene.sensors()[0].sampler()
    sampler.set_sample_count(each)
    # A sampler may round the count up.
    rounds, progress = Rounds(sampler.sample_count()), Progress(count, options, report)
    while rounds.count < count and not progress.is_enough(rounds):
        progress.within(rounds.count)(0.0)
        seed = (native.seed * 1_000_000_007 + rounds.count) % 2**32
        image = np.array(mi.render(scene, spp=each, seed=seed), float)
        rounds.add(image.reshape(-1, image.shape[2]))
    report(1.0)
    return rounds
