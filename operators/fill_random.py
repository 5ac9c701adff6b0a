"""Rows of random numbers, or of numbers that fill a space evenly."""

import bpy

from ..rtb_addon.blender.table_texts import fill
from .design_verbs import DesignVerb, named

SEQUENCES = (
    ("SOBOL", "Sobol", "Sobol's sequence, which fills all ranges together evenly", 1),
    ("RANDOM", "Random", "Independent, uniformly distributed numbers", 2),
)


class RTB_OT_fill_random(DesignVerb, bpy.types.Operator):
    """Rows of numbers that are spread over ranges; the same seed gives the same numbers"""

    bl_idname = "rtb.fill_random"
    bl_label = "Random"

    ranges: bpy.props.StringProperty(
        name="Ranges", description="As in: paint = 0.1 0.9; gloss = 0 1", default="variable = 0 1"
    )
    count: bpy.props.IntProperty(name="Count", default=16, min=1, soft_max=1000)
    seed: bpy.props.IntProperty(name="Seed", min=0)
    sequence: bpy.props.EnumProperty(name="Sequence", items=SEQUENCES)
    fields = ("ranges", "how", "count", "seed", "sequence")

    def begin(self, context, variable):
        self.ranges = f"{variable} = 0 1"

    def edit(self, context):
        from ..rtb_addon import designs  # brings numpy, which enabling need not wait for

        ranges = designs.parse_ranges(self.ranges)
        draw = designs.sobol_numbers if self.sequence == "SOBOL" else designs.random_numbers
        rows = draw(list(ranges.values()), self.count, self.seed)
        fill(context.scene.rtb, list(ranges), rows, named(self.sequence.lower(), rows), self.how)
        return f"{len(rows)} values of {', '.join(ranges)}"
