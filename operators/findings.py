"""What the last export or batch found, one sentence each, for the panel to show."""

from __future__ import annotations

from pathlib import Path

import bpy

errors: list[str] = []
remarks: list[str] = []


def clear() -> None:
    """Forget what was found before."""
    errors.clear()
    remarks.clear()


def exported(recipe, folder: str = "") -> Path:
    """Save a scene's recipe and return its folder; what had to be assumed becomes remarks."""
    clear()
    saved = recipe.save(Path(bpy.path.abspath(folder)) if folder else None)
    remarks.extend(recipe.report)
    return saved


def refuse(operator, error: Exception) -> set[str]:
    """Say in the panel and in the report why an operator cannot go on."""
    clear()
    errors.append(str(error))
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}
