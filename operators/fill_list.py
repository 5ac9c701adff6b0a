"""Rows of values that are typed one after the other."""

import bpy

from ..rtb_addon.errors import RecipeError
from .design_verbs import DesignVerb


class RTB_OT_fill_list(DesignVerb, bpy.types.Operator):
    """A row for each of some values"""

    bl_idname = "rtb.fill_list"
    bl_label = "List"

    values: bpy.props.StringProperty(
        name="Values",
        description="Between commas, as in: 0.2, 0.5, D65; or between semicolons",
        default="0.2, 0.5, 0.8",
    )
    fields = ("variable", "how", "values")

    def edit(self, context):
        separator = ";" if ";" in self.values else ","
        values = [each.strip() for each in self.values.split(separator) if each.strip()]
        if not values:
            raise RecipeError("there are no values, write some between commas: 0.2, 0.5, D65")
        return self.put(context, values)
