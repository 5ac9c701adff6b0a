"""Stop the batch that is rendering."""

import bpy

from . import running


class RTB_OT_cancel_rendering(bpy.types.Operator):
    """Stop rendering; renderings that are done are kept, and the next Render Recipe goes on from there"""

    bl_idname = "rtb.cancel_rendering"
    bl_label = "Cancel Rendering"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        if running.batch is None:
            cls.poll_message_set("No recipe is being rendered")
        return running.batch is not None

    def execute(self, context):
        if running.batch is not None:
            running.batch.cancel()
        return {"FINISHED"}
