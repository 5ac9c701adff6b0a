"""Rows of spectra between two."""

import bpy

from ..rtb_addon.blender.folders import blend_folder
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
        # These bring numpy, which enabling need not wait for.
        from ..rtb_addon.designs import graded
        from ..rtb_addon.spectra.spoken import spectrum_from

        first, last = (spectrum_from(text, folder=blend_folder()) for text in (self.first, self.last))
        return self.put(context, graded(first, last, self.count), kind="SPECTRUM")
