"""
The slow way out where no LLVM works: Mitsuba's stock path and spectral film, in its scalar variant.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import mitsuba as mi
import numpy as np

from ...spectra import FloatArray
from ..interface import Report
from .native import Native

# Paths of a pass: some tenths of a second.
_PATHS = 2**17


def render_stock(scene: mi.Scene, native: Native, report: Report) -> tuple[FloatArray, int]:
    """Return the (height, width, bands) radiance [W sr-1 m-2 nm-1] and how many samples a pixel had."""
    pixels = native.width * native.height
    each = max(1, min(native.samples, _PATHS // pixels))
    passes = -(-native.samples // each)
    total = np.zeros((native.height, native.width, len(native.bands)))
    samples = 0
    for number in range(passes):
        report(number / passes)
        seed = (native.seed * 1_000_000_007 + number) % 2**32
        image = np.array(mi.render(scene, spp=each, seed=seed))
        # A sampler may round the count up.
        total += image
        samples += scene.sensors()[0].sampler().sample_count()
    report(1.0)
    return (total / passes).astype(np.float32), samples
