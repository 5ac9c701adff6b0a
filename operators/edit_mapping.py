"""Another property, or another value, for something that conditions set."""

import bpy

from ..rtb_addon.blender import mapping_edits
from ..rtb_addon.blender.place_words import subject
from ..rtb_addon.blender.places import found_at, refuse_fixed
from .mapping_verbs import MappingVerb

_HOMES = [
    (each, each.replace("_", " ").title(), "", number) for number, each in enumerate(mapping_edits.HOMES)
]


class RTB_OT_edit_mapping(MappingVerb, bpy.types.Operator):
    """Choose what this mapping sets: another thing, another of its properties, another value"""

    bl_idname = "rtb.edit_mapping"
    bl_label = "Edit Mapping"

    home: bpy.props.EnumProperty(name="Kind", items=_HOMES)
    thing: bpy.props.StringProperty(name="Thing")
    path: bpy.props.StringProperty(name="Property", description="Path of the property, as drivers write it")
    component: bpy.props.IntProperty(
        name="Component", description="From 0; -1: all of it", default=-1, min=-1
    )
    value: bpy.props.StringProperty(
        name="Value", description="(variable), or arithmetic such as 2 * (distance)"
    )

    def invoke(self, context, event):
        mapping = self.mapping(context)
        if mapping.thing is not None and (home := mapping_edits.home_of(mapping.thing)):
            self.home, self.thing = home, mapping.thing.name
        self.path, self.component, self.value = mapping.path, mapping.index, mapping.value
        return context.window_manager.invoke_props_dialog(self, width=340, confirm_text="Change")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "home")
        layout.prop_search(self, "thing", bpy.data, self.home)
        for name in ("path", "component", "value"):
            layout.prop(self, name)

    def edit(self, context):
        mapping = self.mapping(context)
        thing = mapping_edits.named(self.home, self.thing)
        called = subject(thing, self.path, self.component)
        place = found_at(thing, self.path, self.component, called)
        refuse_fixed(place, thing, self.path, called)
        mapping_edits.refuse_twice(
            context.scene.rtb, thing, self.path, self.component, called, but=self.index
        )
        mapping.name, mapping.thing = called, thing
        mapping.path, mapping.index, mapping.value = self.path, self.component, self.value
