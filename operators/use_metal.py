"""A metal by its name: both of its measured indices at once."""

import bpy

from ..rtb_addon.blender.fields import owner_of
from ..rtb_addon.blender.material_words import metal_title
from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.errors import RecipeError

_items: list[tuple[str, str, str, int]] = []  # Blender reads them where we keep them


def _metals(operator, context):
    if not _items:
        from ..rtb_addon.spectra.library import metals  # brings numpy, which enabling need not wait for

        for number, name in enumerate(metals()):
            _items.append((name, metal_title(name), "", number))
    return _items


class RTB_OT_use_metal(bpy.types.Operator):
    """Take a metal's measured index and extinction"""

    bl_idname = "rtb.use_metal"
    bl_label = "Metal"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    bl_property = "metal"

    metal: bpy.props.EnumProperty(name="Metal", items=_metals)

    def invoke(self, context, event):
        context.window_manager.invoke_search_popup(self)
        return {"INTERFACE"}  # nothing has been done yet that could be undone

    def execute(self, context):
        try:
            settings = owner_of(context, "ETA")
        except RecipeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        settings.eta, settings.k = f"{self.metal} eta", f"{self.metal} k"
        redraw_panels()
        return {"FINISHED"}
