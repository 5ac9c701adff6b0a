"""What the cells of a column hold."""

import bpy

from ..rtb_addon.blender.table_properties import KINDS
from .table_verbs import ColumnVerb


class RTB_OT_set_variable_kind(ColumnVerb, bpy.types.Operator):
    """Choose what the cells of the active variable hold; what they say stays as it is"""

    bl_idname = "rtb.set_variable_kind"
    bl_label = "Type"

    kind: bpy.props.EnumProperty(name="Type", items=KINDS)

    def edit(self, context):
        settings = context.scene.rtb
        settings.variables[settings.active_variable].kind = self.kind
