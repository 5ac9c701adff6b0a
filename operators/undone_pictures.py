"""
The picture of renderings stays in its Image Editors when something else is undone.

Undo takes every image with it that was not there yet. What renders goes on, so what shows it has to stay.
"""

from __future__ import annotations

from pathlib import Path

import bpy

from . import montages, viewing

_editors: set[int] = set()  # that showed the picture before an undo


@bpy.app.handlers.persistent
def _before_undo(*_) -> None:
    _editors.clear()
    if viewing.seen and (image := montages.find(viewing.seen["name"])) is not None:
        _editors.update(area.as_pointer() for area in montages.editors_of(image))


@bpy.app.handlers.persistent
def _after_undo(*_) -> None:
    if not _editors or not viewing.seen:
        return
    image = montages.find(viewing.seen["name"])
    if image is None:
        image = montages.load(Path(viewing.seen["file"]), viewing.seen["name"])
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.as_pointer() in _editors and area.spaces.active.image is None:
                area.spaces.active.image = image


def _watched() -> list[tuple]:
    handlers = bpy.app.handlers
    before, after = (handlers.undo_pre, handlers.redo_pre), (handlers.undo_post, handlers.redo_post)
    return [*((each, _before_undo) for each in before), *((each, _after_undo) for each in after)]


def register() -> None:
    """Watch what is undone and done again."""
    for handlers, act in _watched():
        handlers.append(act)


def unregister() -> None:
    """Watch no more."""
    for handlers, act in _watched():
        handlers.remove(act)
    _editors.clear()
