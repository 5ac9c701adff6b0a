"""What verbs that say a spectrum have in common."""

import bpy

from ..rtb_addon.blender import preview
from ..rtb_addon.blender.fields import FIELDS, ITEMS, owner_of
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError
from . import scene_edits


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
        if owner.bl_rna.identifier != "RTB_PG_cell":
            scene_edits.note()
        preview.refresh()
        redraw_panels()
        return {"FINISHED"}
