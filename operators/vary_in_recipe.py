"""A spectrum becomes a variable of the conditions."""

import bpy

from ..rtb_addon.blender.fields import FIELDS, varies
from ..rtb_addon.blender.table_edits import add_row, add_variable, free_name
from ..rtb_addon.errors import RecipeError
from .spectrum_verbs import SpectrumVerb

CATEGORY = "RenderToolbox"


class RTB_OT_vary_in_recipe(SpectrumVerb, bpy.types.Operator):
    """Make this spectrum a variable of the conditions; every condition says at first what it is now"""

    bl_idname = "rtb.vary_in_recipe"
    bl_label = "Vary in Recipe"
    bl_options = {"REGISTER", "UNDO"}

    def text(self, context, owner):
        field, settings = FIELDS[self.field], context.scene.rtb
        if not field.variable:
            raise RecipeError("a cell varies already, it is a part of the conditions")
        now = getattr(owner, field.name)
        if varies(now):
            raise RecipeError(f"{now} varies already, its values are in the conditions")
        name = free_name(field.variable, [each.name for each in settings.variables])
        add_variable(settings, name, now, "SPECTRUM")
        if not settings.conditions:
            add_row(settings, "", [now])
        show_table(context)
        return f"({name})"


def show_table(context) -> None:
    """Open the sidebar where the table is, in the largest 3D Viewport."""
    if bpy.app.background or context.window is None:
        return
    viewports = [area for area in context.window.screen.areas if area.type == "VIEW_3D"]
    if viewports:
        viewport = max(viewports, key=lambda area: area.width * area.height)
        viewport.spaces.active.show_region_ui = True
        window = context.window_manager.windows[:].index(context.window)
        bpy.app.timers.register(lambda: _turn_to_tab(window), first_interval=0.2)


def _turn_to_tab(window: int) -> None:
    """Turn to our tab, once the sidebars have been drawn and have tabs."""
    for area in bpy.context.window_manager.windows[window].screen.areas:
        if area.type == "VIEW_3D" and area.spaces.active.show_region_ui:
            for region in area.regions:
                if region.type == "UI" and region.width > 1:
                    region.active_panel_category = CATEGORY
                    region.tag_redraw()
