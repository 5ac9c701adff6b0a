"""Rows of equally spaced numbers."""

import bpy

from .design_verbs import DesignVerb

SPACINGS = (
    ("STEPS", "Equal Steps", "Each number is the one before plus the same", 1),
    ("RATIOS", "Equal Ratios", "Each number is the one before times the same", 2),
)


class RTB_OT_fill_range(DesignVerb, bpy.types.Operator):
    """A row for each of some numbers from one to another"""

    bl_idname = "rtb.fill_range"
    bl_label = "Range"

    first: bpy.props.FloatProperty(name="First", default=0.1, precision=4)
    last: bpy.props.FloatProperty(name="Last", default=0.9, precision=4)
    count: bpy.props.IntProperty(name="Count", default=5, min=1, soft_max=100)
    spacing: bpy.props.EnumProperty(name="Spacing", items=SPACINGS)
    fields = ("variable", "how", "first", "last", "count", "spacing")

    def edit(self, context):
        from ..rtb_addon.designs import spaced  # brings numpy, which enabling need not wait for

        return self.put(context, spaced(self.first, self.last, self.count, self.spacing == "RATIOS"))
