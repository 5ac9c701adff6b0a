"""Every condition with an object and without it."""

import bpy

from ..rtb_addon.blender import mapping_edits
from ..rtb_addon.blender.table_texts import fill
from ..rtb_addon.errors import RecipeError
from .design_verbs import DesignVerb


class RTB_OT_fill_pairs(DesignVerb, bpy.types.Operator):
    """Every condition twice: with an object, and without it"""

    bl_idname = "rtb.fill_pairs"
    bl_label = "Pairs"

    object: bpy.props.StringProperty(name="Object", description="That is there in one of each pair")
    fields = ("variable", "how")

    def begin(self, context, variable):
        active = bpy.context.view_layer.objects.active
        self.object = "" if active is None else active.name
        self.variable, self.how = f"with {self.object}".strip(), "CROSS"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop_search(self, "object", bpy.data, "objects")
        super().draw(context)

    def edit(self, context):
        settings, name = context.scene.rtb, self.variable.strip() or f"with {self.object}"
        thing = bpy.data.objects.get(self.object)
        if thing is None:
            raise RecipeError(f"no object is called '{self.object}', choose one")
        if name not in [each.name for each in settings.variables]:
            called = mapping_edits.subject(thing, "hide_render", -1)
            mapping_edits.refuse_twice(settings, thing, "hide_render", -1, called)
            mapping_edits.add_mapping(settings, thing, "hide_render", -1, f"1 - ({name})")
        fill(settings, [name], [["1"], ["0"]], [f"with-{thing.name}", f"without-{thing.name}"], self.how)
        return f"pairs with and without {thing.name}"
