"""The montage fills while a batch renders."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from . import viewing

if TYPE_CHECKING:
    from .child_batch import ChildBatch

_shown: tuple[ChildBatch, int] | None = None  # what batch was looked at last, and how much it had finished


def follow(batch: ChildBatch) -> None:
    """Show what a batch has finished since last time; its first rendering opens an Image Editor."""
    global _shown
    viewing.wake()  # so that the first picture comes at once
    if batch.finished and _shown != (batch, batch.finished):
        first = _shown is None or _shown[0] is not batch
        _shown = batch, batch.finished
        if first:
            _begin_with(batch)
        viewing.show(batch.folder, open_editor=first)
    viewing.redraw()


def _begin_with(batch: ChildBatch) -> None:
    """Let the view be of what a batch renders, whatever was looked at last."""
    view = bpy.context.window_manager.rtb_view
    view.renderer = "recipe"
    if batch.total > 1:
        view.condition = ""
