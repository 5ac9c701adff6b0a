"""
How the last batch of this session has left each condition, for the table to show.

It lives here and not in Blender's data, so that undo and saving do not touch it. A row whose cells have been
changed since is told from one that is as it was rendered; whether other edits of the scene concern it is
settled by the next Render Recipe, which renders nothing twice.
"""

from __future__ import annotations

from ..rtb_addon.blender.folders import recipe_name
from ..rtb_addon.blender.table_edits import cells_of

STATES = {"started": "running", "progress": "running", "done": "done", "cached": "done", "failed": "failed"}

_cells: dict[str, list[str]] = {}
_states: dict[str, str] = {}
_scene = 0


def begin(scene) -> None:
    """Remember what the table says as a batch begins."""
    global _scene
    clear()
    _scene = scene.session_uid
    for number, row in enumerate(scene.rtb.conditions):
        _cells[row_name(scene, row, number)] = cells_of(scene.rtb, row)


def take(condition: str, kind: str) -> None:
    """Take in what a batch says of a condition."""
    if kind in STATES:
        _states[condition] = STATES[kind]
    else:
        _states.pop(condition, None)


def end() -> None:
    """Forget what was under way, for nothing is any more."""
    for name in [name for name, state in _states.items() if state == "running"]:
        del _states[name]


def clear() -> None:
    """Forget everything."""
    _cells.clear()
    _states.clear()


def known(scene) -> bool:
    """Whether there is anything to show of a scene's table."""
    return bool(_states) and scene.session_uid == _scene


def state(scene, row, number: int) -> str:
    """Return running, done, failed, changed (since it was done) or nothing, of a row; numbers begin at 0."""
    name = row_name(scene, row, number)
    found = _states.get(name, "")
    return "changed" if found == "done" and _cells.get(name) != cells_of(scene.rtb, row) else found


def row_name(scene, row, number: int) -> str:
    """Return the name that a condition has in the recipe."""
    return row.name.strip() or f"{recipe_name(scene)}-{number + 1:03}"
