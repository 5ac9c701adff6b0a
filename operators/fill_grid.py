"""Rows of every combination of several variables' values."""

import bpy

from ..rtb_addon.blender.table_texts import fill
from .design_verbs import DesignVerb, named


class RTB_OT_fill_grid(DesignVerb, bpy.types.Operator):
    """A row for every combination of some values: a factorial design"""

    bl_idname = "rtb.fill_grid"
    bl_label = "Grid"

    values: bpy.props.StringProperty(
        name="Values",
        description="As in: paint = 0.2, 0.5; light = D65, A",
        default="paint = 0.2, 0.5; light = D65, A",
    )
    fields = ("values", "how")

    def begin(self, context, variable):
        self.values = f"{variable} = 0.2, 0.5, 0.8"

    def edit(self, context):
        from ..rtb_addon.designs import grid, parse_lists  # brings numpy, which enabling need not wait for

        values = parse_lists(self.values)
        rows = grid(values)
        fill(context.scene.rtb, list(values), rows, named("grid", rows), self.how)
        return f"{len(rows)} combinations of {', '.join(values)}"
