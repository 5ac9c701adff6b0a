"""A recipe rendered from Python in one line, for scripts that need no events."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..errors import RenderingError
from ..recipe.resources import listed
from . import records, render_recipe
from .saving import Rendering


def execute_recipe(folder: Path | str, **options: Any) -> list[Rendering]:
    """
    Render the recipe in a folder to its end and return its renderings, in the order they were ready.

    Parameters
    ----------
    options : of render_recipe

    Raises
    ------
    RecipeError
        When the recipe is wrong, before anything is rendered.
    RenderingError
        When conditions failed; the others are done and kept.
    """
    events = list(render_recipe(folder, **options))
    failed: dict[str, list[str]] = {}
    for event in events:
        if event.kind == "failed":
            failed.setdefault(event.message, []).append(event.condition)
    if failed:
        raise RenderingError("; ".join(f"{sentence} ({listed(names)})" for sentence, names in failed.items()))
    ends = [event for event in events if event.kind in {"done", "cached"}]
    files = {event.condition: Path(event.file) for event in ends}
    recorded = {name: records.read(file.with_suffix(".json")) for name, file in files.items()}
    return [
        Rendering(event.condition, files[event.condition], recorded[event.condition], event.kind == "done")
        for event in ends
    ]
