"""
Numbers on the device.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from typing import Any

import mitsuba as mi
import numpy as np

# Drjit fetches four numbers at once where they begin at a multiple of as many bytes.
_ALIGNMENT = 64


def floats(values) -> Any:
    """
    Return numbers on the device, in reading order, so that no kernel depends on them.

    Notes
    -----
    Drjit takes numpy's memory as it is, and compiles another kernel where that begins somewhere else.
    """
    flat = np.ravel(np.asarray(values, np.float32))
    size = max(len(flat), 1) * flat.itemsize
    room = np.zeros(size + _ALIGNMENT, np.uint8)
    start = -room.ctypes.data % _ALIGNMENT
    aligned = room[start : start + size].view(np.float32)
    aligned[: len(flat)] = flat
    return mi.Float(aligned)
