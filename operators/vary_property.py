"""Any property of the file becomes a variable of the conditions."""

import bpy

from ..rtb_addon.blender import mapping_edits
from .table_verbs import TableVerb
from .vary_in_recipe import show_table


class RTB_OT_vary_property(TableVerb, bpy.types.Operator):
    """Make this property a variable of the conditions; every condition says at first what it is now"""

    bl_idname = "rtb.vary_property"
    bl_label = "Vary in Recipe"

    home: bpy.props.StringProperty(name="Home", description="List of bpy.data that holds it, like objects")
    thing: bpy.props.StringProperty(name="Thing", description="Its name there")
    path: bpy.props.StringProperty(name="Property", description="Path of the property, as drivers write it")
    index: bpy.props.IntProperty(name="Component", description="Of a vector, from 0; -1 for all", default=-1)
    variable: bpy.props.StringProperty(
        name="Variable",
        description="Name of the new variable; empty: after the property",
        options={"SKIP_SAVE"},
    )

    def edit(self, context):
        thing = mapping_edits.named(self.home, self.thing)
        name = mapping_edits.vary(context.scene.rtb, thing, self.path, self.index, self.variable.strip())
        show_table(context)
        return f"{name} is a variable of the conditions"
