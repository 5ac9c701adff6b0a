"""A spectrum that the conditions say."""

import bpy

from ..rtb_addon.blender.table_edits import refuse_unknown
from .spectrum_verbs import SpectrumVerb


class RTB_OT_use_variable(SpectrumVerb, bpy.types.Operator):
    """Take the spectrum from this variable of the conditions"""

    bl_idname = "rtb.use_variable"
    bl_label = "Condition Variable"

    variable: bpy.props.StringProperty(name="Variable")

    def text(self, context, owner):
        refuse_unknown(context.scene.rtb, self.variable)
        return f"({self.variable})"
