"""The renderers, found by name. Each is imported only when somebody asks for it."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.metadata import entry_points

from ..errors import RecipeError
from .interface import Renderer

_MODULES = {"mitsuba": ".mitsuba", "sphere": ".sphere", "tracer": ".tracer"}
_added: dict[str, Callable[[], Renderer]] = {}


def add(name: str, make: Callable[[], Renderer]) -> None:
    """Make a renderer known to this process; others come by entry point ``rtb_addon.renderers``."""
    _added[name.lower()] = make


def names() -> list[str]:
    """Return the names of every renderer that find() knows, in alphabetical order."""
    return sorted({*_MODULES, *_added, *_entry_points()})


def find(name: str) -> Renderer:
    """Return a renderer by its name, in any case of letters."""
    key = name.lower()
    if key in _added:
        return _added[key]()
    if key in _MODULES:
        return import_module(_MODULES[key], __name__).renderer()
    if key in (others := _entry_points()):
        return others[key].load()()
    raise RecipeError(f"no renderer is called {name}, choose one of {', '.join(names())}")


def _entry_points() -> dict:
    return {point.name.lower(): point for point in entry_points(group="rtb_addon.renderers")}


__all__ = ["add", "find", "names"]
