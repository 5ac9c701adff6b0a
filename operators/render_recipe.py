"""Render the recipe of a scene, in a process of its own."""

import bpy

from . import findings, row_states, running
from .reading import ReadingVerb


class RenderVerb(ReadingVerb):
    """An operator that renders some conditions, all of them where none is chosen."""

    @classmethod
    def poll(cls, context):
        if running.batch is not None:
            cls.poll_message_set("A recipe is being rendered: wait for it, or cancel it")
        return running.batch is None

    def go_on(self, context, folder):
        chosen = self.chosen(context)
        row_states.begin(context.scene, chosen)
        batch = running.start(folder, chosen)
        return self._followed(batch) if bpy.app.background else {"FINISHED"}

    def chosen(self, context) -> list[str]:
        """Return the names of the conditions to render."""
        return []

    def _followed(self, batch):
        """Wait for the batch, as there is no window to keep alive."""
        running.follow_to_the_end(batch)
        if findings.errors:
            self.report({"ERROR"}, "; ".join(findings.errors))
        return {"CANCELLED"} if batch.cancelled or findings.errors else {"FINISHED"}


class RTB_OT_render_recipe(RenderVerb, bpy.types.Operator):
    """Write the recipe and render every condition that is not done yet, while you go on working"""

    bl_idname = "rtb.render_recipe"
    bl_label = "Render Recipe"
    bl_options = {"REGISTER"}
