"""
How each condition was left by the batches of this file, for the table to show.

It lives here and not in Blender's data, so that undo does not touch it; a file that is saved takes it along.
A row whose cells or options have been changed since is told from one that is as it was rendered. Whether an
edit of something else concerns a row is settled by the next Check or Render Recipe.
"""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from ..rtb_addon.blender.folders import recipe_name
from ..rtb_addon.blender.table_edits import cells_of
from . import scene_edits

KINDS = {"started": "running", "progress": "running", "done": "done", "cached": "done", "failed": "failed"}
# What decides how all conditions render, of the scene's own properties.
_OPTIONS = (
    *("renderer", "width", "height", "samples", "until_error", "seed", "filter", "integrator", "depth"),
    *("bands_start", "bands_step", "bands_count", "band_kind", "further", "units", "handedness"),
)


class Said(NamedTuple):
    """
    What the scene said of a condition when it was begun.

    Parameters
    ----------
    cells, options : as they were; to the options counts what mappings are written
    edits : how many times the scene had been edited otherwise, and its frame
    """

    cells: list[str]
    options: list[object]
    edits: tuple[int, int]


@dataclass
class Rows:
    """
    What is known of a scene's conditions, by their names.

    Attributes
    ----------
    begun : what the scene said as the batch began that is under way, or was the last one
    before : how those were that are under way
    said : what the scene said of those that are done
    states : one of KINDS' values
    reasons : why one failed
    versions : numbers that are others once a condition has been rendered anew
    """

    begun: dict[str, Said] = field(default_factory=dict)
    before: dict[str, str] = field(default_factory=dict)
    said: dict[str, Said] = field(default_factory=dict)
    states: dict[str, str] = field(default_factory=dict)
    reasons: dict[str, str] = field(default_factory=dict)
    versions: dict[str, int] = field(default_factory=dict)

    def as_before(self, condition: str) -> None:
        """Let a condition be as it was before a batch that has not finished it."""
        self.states[condition] = self.before.pop(condition, self.states.get(condition, ""))


_rows: dict[int, Rows] = {}  # by the number of the scene in this session
_batch = Rows()  # those of the scene that is being rendered, or was last
_count = 0


def begin(scene, names: Iterable[str] = ()) -> None:
    """Remember what the table says as a batch of some conditions, or of all of them, begins."""
    global _batch
    _batch = _rows.setdefault(scene.session_uid, Rows())
    said, chosen = what_it_says(scene), set(names)
    _batch.begun = {name: each for name, each in said.items() if not chosen or name in chosen}


def what_it_says(scene) -> dict[str, Said]:
    """Return what a scene says now of each of its conditions."""
    common = _options(scene), _edits(scene)
    rows = enumerate(scene.rtb.conditions)
    return {row_name(scene, row, number): Said(cells_of(scene.rtb, row), *common) for number, row in rows}


def settle(scene, said: Mapping[str, Said], done: Iterable[str]) -> None:
    """Take in which conditions, as the scene has said them, a batch would find done."""
    rows, found = _rows.setdefault(scene.session_uid, Rows()), set(done)
    for name, each in said.items():
        if name in found:
            rows.states[name], rows.said[name] = "done", each
            rows.reasons.pop(name, None)
        elif rows.states.get(name) == "done":
            rows.said[name] = Said(["changed"], [], each.edits)


def take(condition: str, kind: str, reason: str = "") -> None:
    """Take in what the batch says of a condition, and why it failed if it did."""
    global _count
    rows = _batch
    if KINDS.get(kind) == "running":
        rows.before.setdefault(condition, rows.states.get(condition, ""))
        rows.states[condition] = "running"
    elif kind in KINDS:
        rows.before.pop(condition, None)
        rows.states[condition], rows.reasons[condition] = KINDS[kind], reason
        if condition in rows.begun:
            rows.said[condition] = rows.begun[condition]
    else:
        rows.as_before(condition)
    if kind == "done":
        _count += 1
        rows.versions[condition] = _count


def end() -> None:
    """Let what was under way be as it was, for nothing is any more."""
    for name in list(_batch.before):
        _batch.as_before(name)


def clear() -> None:
    """Forget everything."""
    global _batch
    _rows.clear()
    _batch = Rows()


def known(scene) -> bool:
    """Whether there is anything to show of a scene's table."""
    return scene.session_uid in _rows and bool(_rows[scene.session_uid].states)


def state(scene, row, number: int) -> str:
    """
    Return how a row is; numbers begin at 0.

    Returns
    -------
    running, failed, done, nothing where it was never rendered; of one that was done: changed, where its cells
    or the options are others now, unchecked, where something else of the scene has been edited
    """
    if (rows := _rows.get(scene.session_uid)) is None:
        return ""
    name = row_name(scene, row, number)
    found = rows.states.get(name, "")
    if found != "done" or (said := rows.said.get(name)) is None:
        return found
    if said.cells != cells_of(scene.rtb, row) or said.options != _options(scene):
        return "changed"
    return "done" if said.edits == _edits(scene) else "unchecked"


def state_of(scene, name: str) -> str:
    """Return the same for the row of a name, nothing where there is none."""
    rows = enumerate(scene.rtb.conditions)
    return next((state(scene, row, k) for k, row in rows if row_name(scene, row, k) == name), "")


def reason(scene, name: str) -> str:
    """Return why a condition failed, nothing where nobody knows."""
    return _rows[scene.session_uid].reasons.get(name, "") if scene.session_uid in _rows else ""


def version(scene, name: str) -> int:
    """Return a number that is another one once a condition has been rendered anew."""
    return _rows[scene.session_uid].versions.get(name, 0) if scene.session_uid in _rows else 0


def row_name(scene, row, number: int) -> str:
    """Return the name that a condition has in the recipe."""
    return row.name.strip() or f"{recipe_name(scene)}-{number + 1:03}"


def keep(scenes) -> None:
    """Write into a file that is about to be saved what was done of its conditions."""
    for scene in scenes:
        if (rows := _rows.get(scene.session_uid)) is None:
            continue
        for number, row in enumerate(scene.rtb.conditions):
            name = row_name(scene, row, number)
            state = rows.before.get(name, rows.states.get(name))
            said = rows.said.get(name) if state == "done" else None
            row.rendered = "" if said is None else json.dumps([name, said.cells, said.options])


def remember(scenes) -> None:
    """Take in what a file that was opened says of its conditions; whether they still fit nobody knows."""
    clear()
    for scene in scenes:
        for row in scene.rtb.conditions:
            if (read := _read(row.rendered)) is not None:
                rows, (name, said) = _rows.setdefault(scene.session_uid, Rows()), read
                rows.states[name], rows.said[name] = "done", said


def _read(text: str) -> tuple[str, Said] | None:
    """Return what a row says of itself; a file may come from anybody: no such text says nothing."""
    try:
        name, cells, options = json.loads(text)
    except (ValueError, TypeError):
        return None
    return (name, Said(cells, options, (-1, 0))) if isinstance(name, str) else None


def _options(scene) -> list[object]:
    text = scene.rtb.mappings_text
    written = 0 if text is None else zlib.crc32(text.as_string().encode())
    return [*(getattr(scene.rtb, name) for name in _OPTIONS), sorted(scene.rtb.layers), written]


def _edits(scene) -> tuple[int, int]:
    return scene_edits.count, scene.frame_current
