"""What the last check, export or batch found, one sentence each, for the panel to show."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from ..rtb_addon.blender.redrawing import redraw_panels

if TYPE_CHECKING:
    from .culprits import Culprit

errors: list[str] = []
remarks: list[str] = []
culprits: dict[str, Culprit] = {}
mappings: list[str] = []  # lines as they were written last, and how many of them are not of the scene's text
generated = 0
about = 0  # number in this session of the scene that was looked at, 0 where nothing was found


def clear() -> None:
    """Forget what was found before."""
    global about
    about = 0
    errors.clear()
    remarks.clear()
    culprits.clear()


def note(problems: Iterable[str] = (), others: Iterable[str] = ()) -> None:
    """Add problems and remarks, each once, with what they speak of."""
    from .culprits import culprit_of

    global about
    about = about or bpy.context.scene.session_uid
    for found, known in ((problems, errors), (others, remarks)):
        for sentence in found:
            if sentence not in known:
                known.append(sentence)
                if (culprit := culprit_of(sentence, bpy.context.scene, mappings, generated)) is not None:
                    culprits[sentence] = culprit
    redraw_panels()
    if not bpy.app.background:  # panels below one that grows move a moment later
        bpy.app.timers.register(redraw_panels, first_interval=0.2)


def is_about(scene) -> bool:
    """Return whether what was found concerns a scene; another one of the file has a recipe of its own."""
    return about in (0, scene.session_uid)


def exported(recipe, folder: str = "") -> Path:
    """Save a scene's recipe and return its folder; what had to be assumed becomes remarks."""
    clear()
    return written(recipe, recipe.save(named(folder)))


def named(folder: str) -> Path | None:
    """Return the folder that an operator names, None where it names none."""
    return Path(bpy.path.abspath(folder)) if folder else None


def written(recipe, folder: Path) -> Path:
    """Take in what is to be said of a recipe that was saved in a folder, and return that."""
    global generated
    clear()
    mappings[:], generated = recipe.mappings.splitlines(), recipe.generated
    note(others=recipe.report)
    return folder


def refuse(operator, error: Exception) -> set[str]:
    """Say in the panel and in the report why an operator cannot go on."""
    clear()
    note([str(error)])
    operator.report({"ERROR"}, str(error))
    return {"CANCELLED"}
