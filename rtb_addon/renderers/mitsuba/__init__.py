"""Mitsuba 3: translation into its own format, and our spectral path through its plugins."""

from .renderer import MitsubaRenderer


def renderer() -> MitsubaRenderer:
    """Return the renderer."""
    return MitsubaRenderer()


__all__ = ["MitsubaRenderer", "renderer"]
