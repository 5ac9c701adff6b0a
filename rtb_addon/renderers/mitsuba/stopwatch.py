"""
What a rendering's time went into: loading, compiling, following paths.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import time
from contextlib import AbstractContextManager
from typing import Any

import drjit as dr


class Stopwatch:
    """A context in which a scene is loaded and then rendered."""

    def __enter__(self) -> Stopwatch:
        self._began = self._loaded = time.monotonic()
        self._history: AbstractContextManager[Any] = dr.scoped_set_flag(dr.JitFlag.KernelHistory, True)
        self._history.__enter__()
        dr.kernel_history_clear()
        return self

    def has_loaded(self) -> None:
        """Note that the scene is loaded."""
        self._loaded = time.monotonic()

    def __exit__(self, *raised: Any) -> None:
        self._ended = time.monotonic()
        # Times of drjit's are in thousandths of a second.
        self._kernels = [each for each in dr.kernel_history() if each["type"] == dr.KernelType.JIT]
        self._compiling = sum(each["backend_time"] for each in self._kernels) / 1000
        self._history.__exit__(*raised)

    def facts(self) -> dict[str, str]:
        """Return the seconds of each, how many kernels ran, and how many were compiled."""
        spans = {
            "loading": self._loaded - self._began,
            "compiling": self._compiling,
            "rendering": self._ended - self._loaded - self._compiling,
        }
        compiled = sum(not each["cache_hit"] for each in self._kernels)
        counts = {"kernels": str(len(self._kernels)), "kernels_compiled": str(compiled)}
        return {**{f"seconds_{what}": f"{span:.3f}" for what, span in spans.items()}, **counts}
