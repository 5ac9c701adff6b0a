"""
Verbs that begin with a look at the scene: at once from a script, a little at a time from a button.

What conditions set is looked at one condition after the other, each of which takes its time; between two of
them the scene is as the user knows it, and must stay so. What becomes of it is made and written by a thread.
"""

from __future__ import annotations

import threading
import time
from pathlib import Path

import bpy

from ..rtb_addon.blender import read_recipe
from ..rtb_addon.blender.folders import is_unsaved
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError
from . import findings

INTERVAL = 0.01  # [s] between two turns
TURN = 0.03  # [s] after which a turn begins no other condition

now: Reading | None = None  # the scene that is being read, for panels to show


class Reading:
    """
    A scene that is read and written to a folder, its own unless said otherwise.

    Attributes
    ----------
    share : how much has been looked at, 0 to 1
    """

    def __init__(self, scene, folder: str = "") -> None:
        from ..rtb_addon.blender.reading import read_in_steps  # brings numpy and more

        self.share, self._folder = 0.0, findings.named(folder)
        self._steps = read_in_steps(scene)
        self.timer: bpy.types.Timer | None = None
        self._thread: threading.Thread | None = None
        self._written: tuple | None = None
        self._error: Exception | None = None

    def turn(self) -> tuple | None:
        """Go on for a moment; return the recipe and its folder once it is written; raise why it cannot be."""
        if self._thread is None:
            self._look()
        elif not self._thread.is_alive():
            if self._error is not None:
                raise self._error
            return self._written
        return None

    def stop(self) -> None:
        """Leave it, the scene being as it was."""
        self._steps.close()
        if self._thread is not None:
            self._thread.join()

    def _look(self) -> None:
        until = time.perf_counter() + TURN
        while time.perf_counter() < until:
            try:
                self.share = next(self._steps)
            except StopIteration as end:
                self._thread = threading.Thread(target=self._write, args=(end.value,))
                self._thread.start()
                return

    def _write(self, finish) -> None:
        try:
            recipe = finish()
            self._written = recipe, recipe.save(self._folder)
        except Exception as error:  # which is told where somebody listens
            self._error = error


def leave() -> None:
    """Leave what is being read, if anything, done or not; the scene is as it was."""
    global now
    if now is not None:
        left, now = now, None
        left.stop()
        bpy.context.window_manager.event_timer_remove(left.timer)
        if bpy.context.workspace is not None:
            bpy.context.workspace.status_text_set(None)
        redraw_panels()


class ReadingVerb:
    """An operator that writes the scene's recipe, into its own folder unless it has one, and then goes on."""

    folder = ""

    def execute(self, context):
        try:
            folder = findings.exported(read_recipe(context.scene), self.folder)
        except RecipeError as error:
            return self.refused(context, error)
        return self.go_on(context, folder)

    def invoke(self, context, event):
        global now
        if not self.folder and is_unsaved(context.scene):
            self.report({"INFO"}, "Save the file first: its recipe goes beside it")
            bpy.ops.wm.save_as_mainfile("INVOKE_DEFAULT")
            return {"CANCELLED"}
        if now is not None:
            self.report({"INFO"}, "The scene is being read: wait for it, or stop it with Esc")
            return {"CANCELLED"}
        if len(context.scene.rtb.conditions) < 2 or context.window is None:
            return self.execute(context)
        now = Reading(context.scene, self.folder)
        now.timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        context.workspace.status_text_set("Reading the scene, Esc stops")
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.cancel(context)
            self.report({"INFO"}, "Stopped reading the scene, which is as it was")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}  # nothing may change meanwhile
        try:
            written = now.turn() if now is not None else None
        except RecipeError as error:
            self.cancel(context)
            return self.refused(context, error)
        except BaseException:
            self.cancel(context)
            raise
        redraw_panels()
        if written is None:
            return {"RUNNING_MODAL"}
        self.cancel(context)
        return self.go_on(context, findings.written(*written))

    def cancel(self, context):
        """Leave the reading, done or not."""
        leave()

    def refused(self, context, error: RecipeError) -> set[str]:
        """Say why the recipe cannot be written."""
        return findings.refuse(self, error)

    def go_on(self, context, folder: Path) -> set[str]:
        """Say where the recipe is; other verbs do more with it."""
        self.report({"INFO"}, f"Recipe written to {folder}")
        return {"FINISHED"}
