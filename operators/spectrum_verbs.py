"""What verbs that say a spectrum have in common."""

from __future__ import annotations

import bpy

from ..rtb_addon.blender import preview
from ..rtb_addon.blender.fields import FIELDS, ITEMS, owner_of
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError


class SpectrumVerb:
    """An operator that writes a spectrum, as a person would type it, into a field."""

    bl_options = {"REGISTER", "UNDO", "INTERNAL"}

    field: bpy.props.EnumProperty(name="Field", items=ITEMS)

    def execute(self, context):
        try:
            owner = owner_of(context, self.field)
            setattr(owner, FIELDS[self.field].name, self.text(context, owner))
        except RecipeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        preview.refresh()
        redraw_panels()
        return {"FINISHED"}


class AskingVerb(SpectrumVerb):
    """One that asks for a number or a colour first."""

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self, confirm_text="Use")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(self, self.asked)
