"""A line of the written mappings less."""

import bpy

from .mapping_verbs import LineVerb


class RTB_OT_remove_mapping_line(LineVerb, bpy.types.Operator):
    """Take this line out of the written mappings"""

    bl_idname = "rtb.remove_mapping_line"
    bl_label = "Remove Line"

    def edit(self, context):
        from ..rtb_addon.blender import written_mappings  # enabling need not wait for it

        written_mappings.remove(context.scene, self.line)
