"""Functions that are handed over from Python, as text that stands by itself."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable, Collection
from typing import Any

from ..errors import RecipeError


def source_of(function: Callable[..., Any], names: Collection[str]) -> tuple[str, str, int]:
    """
    Return a function's source, its file and its first line.

    Another process will run it, so it must have one of the names and use nothing that stands around it.
    """
    name = getattr(function, "__name__", repr(function))
    if name not in names or not inspect.isfunction(function):
        raise RecipeError(f"{name} is no remodeler, write a function called {' or '.join(names)}")
    if used := _used_from_outside(function):
        raise RecipeError(
            f"{name} uses {', '.join(used)} from outside, but travels alone; import or define that inside it"
        )
    try:
        lines, first = inspect.getsourcelines(function)
    except (OSError, TypeError) as error:
        raise RecipeError(f"the source of {name} cannot be found, write it into a file") from error
    return textwrap.dedent("".join(lines)), inspect.getsourcefile(function) or "remodeler", first


def _used_from_outside(function: Callable[..., Any]) -> list[str]:
    used = inspect.getclosurevars(function)
    return sorted({*used.nonlocals, *used.globals})
