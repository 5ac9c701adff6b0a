"""Mitsuba in this process: its variant, its threads, and where its messages go."""

from __future__ import annotations

import sys
from types import ModuleType

from ...errors import RenderingError
from .plugins import register

# Of the lobe path, and of the all-bands path.
FAST, GPU = "llvm_ad_rgb", "cuda_ad_rgb"
FAST_BANDS, GPU_BANDS = "llvm_ad_spectral", "cuda_ad_spectral"
SLOW = "scalar_spectral"


def start(variant: str, threads: int) -> ModuleType:
    """Return mitsuba, ready for a variant with our plugins; its messages go to stderr, never to stdout."""
    import drjit as dr
    import mitsuba as mi

    if mi.variant() != variant:
        mi.set_variant(variant)
    register(mi)
    _send_messages_to_stderr(mi)
    dr.set_thread_count(threads)
    return mi


def require_gpu() -> None:
    """Raise where there is no graphics card that Mitsuba can use."""
    import drjit as dr

    if not dr.has_backend(dr.JitBackend.CUDA):
        raise RenderingError("Mitsuba finds no NVIDIA graphics card here, render without gpu")


def _send_messages_to_stderr(mi: ModuleType) -> None:
    class Stderr(mi.Appender):
        def append(self, level, text):
            # The samples that a picture really took are written in it.
            if "Sample count rounded up" not in text:
                print(text, file=sys.stderr)

        def log_progress(self, progress, name, formatted, eta, ptr=None):
            pass

    logger = mi.logger()
    logger.set_log_level(mi.LogLevel.Warn)
    logger.clear_appenders()
    logger.add_appender(Stderr())
