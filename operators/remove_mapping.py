"""A property that conditions no longer set."""

import bpy

from .mapping_verbs import MappingVerb


class RTB_OT_remove_mapping(MappingVerb, bpy.types.Operator):
    """Let conditions no longer set this property; its variable stays"""

    bl_idname = "rtb.remove_mapping"
    bl_label = "Remove Mapping"

    def edit(self, context):
        self.mapping(context)
        context.scene.rtb.mappings.remove(self.index)
