"""Which renderers the last test has found; it lives as long as Blender runs."""

from __future__ import annotations

from typing import NamedTuple


class Found(NamedTuple):
    """A renderer's version, or None and why it is missing."""

    version: str | None
    reason: str = ""


found: dict[str, Found] = {}
