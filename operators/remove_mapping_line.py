"""A line of the written mappings less."""

import bpy

from ..rtb_addon.blender import written_mappings
from .mapping_verbs import LineVerb


class RTB_OT_remove_mapping_line(LineVerb, bpy.types.Operator):
    """Take this line out of the written mappings"""

    bl_idname = "rtb.remove_mapping_line"
    bl_label = "Remove Line"

    def edit(self, context):
        written_mappings.remove(context.scene, self.line)
