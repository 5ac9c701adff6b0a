"""
Files that are opened, saved, undone and rendered: what must be taken back or brought up to date then.

A preview never gets into a file, an undo or a rendering of Blender's; it comes back afterwards.
"""

from __future__ import annotations

import bpy

from ..rtb_addon.blender import migration, preview
from . import row_states, scene_edits, thumbnails
from .preferred import begin_file
from .render_engine import ENGINE


@bpy.app.handlers.persistent
def _take_back(*_) -> None:
    preview.take_back()


@bpy.app.handlers.persistent
def _show_again(*_) -> None:
    preview.refresh()


@bpy.app.handlers.persistent
def _before_saving(*_) -> None:
    preview.take_back()
    migration.migrate()
    row_states.keep(bpy.data.scenes)


@bpy.app.handlers.persistent
def _after_loading(*_) -> None:
    preview.take_back()  # of a file that was saved automatically
    bpy.context.window_manager.rtb_preview = False
    migration.migrate()
    begin_file()
    row_states.remember(bpy.data.scenes)
    scene_edits.listen()


@bpy.app.handlers.persistent
def _before_rendering(scene, *_) -> None:
    preview.begin_rendering(scene, scene.render.engine == ENGINE)


def _watched() -> dict:
    """Return what is called when; saving can fail, in versions of Blender that say so."""
    return {
        "save_pre": _before_saving,
        "save_post": _show_again,
        "save_post_fail": _show_again,
        "load_post": _after_loading,
        "undo_pre": _take_back,
        "undo_post": _show_again,
        "redo_pre": _take_back,
        "redo_post": _show_again,
        "render_init": _before_rendering,
        "render_complete": _show_again,
        "render_cancel": _show_again,
    }


def _toggled(window_manager, context) -> None:
    preview.refresh()


def register() -> None:
    """Watch, and let windows have a preview."""
    bpy.types.WindowManager.rtb_preview = bpy.props.BoolProperty(
        name="Preview Condition",
        description="Show the active condition in the viewport; the file stays as it is",
        update=_toggled,
        options={"SKIP_SAVE"},
    )
    scene_edits.register()
    thumbnails.register()
    for name, act in _watched().items():
        if hasattr(bpy.app.handlers, name):
            getattr(bpy.app.handlers, name).append(act)


def unregister() -> None:
    """Take the preview back, and watch no more."""
    for name, act in _watched().items():
        if act in getattr(bpy.app.handlers, name, ()):
            getattr(bpy.app.handlers, name).remove(act)
    thumbnails.unregister()
    scene_edits.unregister()
    if hasattr(bpy.data, "scenes"):  # not while Blender ends
        preview.take_back()
    del bpy.types.WindowManager.rtb_preview
