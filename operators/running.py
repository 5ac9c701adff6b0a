"""
The batch that is rendering now, if any: one at a time for the file that is open.

It lives here and not in Blender's data, so that undo and saving do not touch it.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import bpy

from . import child_verb, findings, following, montages, reading, row_states, viewing
from .tell import tell

if TYPE_CHECKING:
    from .child_batch import ChildBatch

INTERVAL = 0.1  # [s] between two looks at what the child has said

batch: ChildBatch | None = None


def start(folder: Path, conditions: Sequence[str] = ()) -> ChildBatch:
    """Start rendering a recipe's folder, or some of its conditions; with an interface, a timer follows it."""
    from .child_batch import ChildBatch  # brings subprocess and more, which enabling need not wait for

    global batch
    batch = ChildBatch(folder, conditions, row_states.take)
    if not bpy.app.background:
        bpy.app.timers.register(_look, first_interval=INTERVAL, persistent=True)
    return batch


def follow_to_the_end(started: ChildBatch) -> None:
    """Wait for a batch that was started."""
    try:
        started.follow_to_the_end()
    finally:
        _conclude(started)


def stop() -> None:
    """End the batch now, for the file or the extension is about to go; what is done is kept."""
    global batch
    if batch is not None:
        batch.stop()
        batch = None
        row_states.end()
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)


def _look() -> float | None:
    """Take in what the child has said; Blender calls this and goes on."""
    if batch is None:
        return None
    if batch.take():
        _redraw()
        following.follow(batch)
    if not batch.ended:
        return INTERVAL
    _conclude(batch)
    return None


def _conclude(ended: ChildBatch) -> None:
    """Tell how a batch ended; without a window its montage becomes an image now, with one it is there."""
    global batch
    batch = None
    row_states.end()
    findings.note(ended.failures, ended.warnings)
    viewing.redraw()
    if bpy.app.background and ended.montage is not None and ended.montage.is_file():
        montages.load(ended.montage, ended.montage.stem)
    tell(*_outcome(ended))
    _redraw()


def _outcome(ended: ChildBatch) -> tuple[str, str]:
    """Return in one sentence how a batch ended, and how grave that is."""
    done = f"{ended.finished - len(ended.failures)} of {ended.total} conditions are done"
    done += f", {ended.found} of them from before" if ended.found else ""
    if ended.failures and ended.finished > len(ended.failures):
        return "WARNING", f"{done}, {ended.failures[0]}"
    if ended.failures:
        return "ERROR", ended.failures[0]
    return "INFO", f"Rendering stopped, {done}" if ended.cancelled else f"Recipe rendered, {done}"


def _redraw() -> None:
    """Let the sidebars and the status bar be drawn anew, but not the scene, which may take long."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if region.type == "UI":
                    region.tag_redraw()
    # The status bar is no area of a screen, but it listens to this.
    bpy.msgbus.publish_rna(key=(bpy.types.Window, "view_layer"))


@bpy.app.handlers.persistent
def _before_loading(*_) -> None:
    stop()
    child_verb.stop_all(only_of_file=True)
    findings.clear()
    row_states.clear()


def register() -> None:
    """Watch for another file being opened."""
    bpy.app.handlers.load_pre.append(_before_loading)


def unregister() -> None:
    """Leave no child and no timer behind."""
    reading.leave()
    stop()
    child_verb.stop_all()
    findings.clear()
    row_states.clear()
    bpy.app.handlers.load_pre.remove(_before_loading)
