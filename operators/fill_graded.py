"""Rows of spectra between two."""

import bpy

from ..rtb_addon.blender.own_spectra import heard
from .design_verbs import DesignVerb


class RTB_OT_fill_graded(DesignVerb, bpy.types.Operator):
    """Rows of spectra that go from one to another in equal steps"""

    bl_idname = "rtb.fill_graded"
    bl_label = "Graded Spectra"

    first: bpy.props.StringProperty(name="First", default="BabelColor Average/blue")
    last: bpy.props.StringProperty(name="Last", default="BabelColor Average/yellow")
    count: bpy.props.IntProperty(name="Count", default=5, min=2, soft_max=100)
    fields = ("variable", "how", "first", "last", "count")

    def edit(self, context):
        # This brings numpy, which enabling need not wait for.
        from ..rtb_addon.designs import graded

        first, last = heard(self.first), heard(self.last)
        return self.put(context, graded(first, last, self.count), kind="SPECTRUM")
