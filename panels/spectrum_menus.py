"""The ways to say a spectrum: a menu beside each field that holds one, and in its context menu."""

import bpy

from ..operators.use_blackbody import RTB_OT_use_blackbody
from ..operators.use_colour import RTB_OT_use_colour
from ..operators.use_daylight import RTB_OT_use_daylight
from ..operators.use_flat_spectrum import RTB_OT_use_flat_spectrum
from ..operators.use_library_spectrum import RTB_OT_use_library_spectrum
from ..operators.use_spectrum_file import RTB_OT_use_spectrum_file
from ..operators.use_variable import RTB_OT_use_variable
from ..operators.vary_in_recipe import RTB_OT_vary_in_recipe
from ..rtb_addon.blender.fields import field_of


class SpectrumMenu:
    """The menu of a field; which one says the class, as menus take no arguments."""

    bl_label = "Spectrum"
    field: str

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator(
            RTB_OT_use_library_spectrum.bl_idname, text="Library…", icon="VIEWZOOM"
        ).field = self.field
        layout.operator(
            RTB_OT_use_spectrum_file.bl_idname, text="File…", icon="FILEBROWSER"
        ).field = self.field
        layout.separator()
        for verb in (RTB_OT_use_flat_spectrum, RTB_OT_use_daylight, RTB_OT_use_blackbody, RTB_OT_use_colour):
            layout.operator(verb.bl_idname, text=f"{verb.bl_label}…").field = self.field
        if self.field != "CELL":
            layout.separator()
            self.draw_variables(layout, context.scene.rtb)

    def draw_variables(self, layout, settings):
        """Draw what the conditions may say."""
        for variable in settings.variables:
            entry = layout.operator(RTB_OT_use_variable.bl_idname, text=f"Variable ({variable.name})")
            entry.field, entry.variable = self.field, variable.name
        layout.operator(RTB_OT_vary_in_recipe.bl_idname, text="New Variable").field = self.field


class RTB_MT_reflectance(SpectrumMenu, bpy.types.Menu):
    """What a surface reflects"""

    bl_idname = "RTB_MT_reflectance"
    field = "REFLECTANCE"


class RTB_MT_light(SpectrumMenu, bpy.types.Menu):
    """What a lamp sends out"""

    bl_idname = "RTB_MT_light"
    field = "LIGHT"


class RTB_MT_world(SpectrumMenu, bpy.types.Menu):
    """What comes from all around"""

    bl_idname = "RTB_MT_world"
    field = "WORLD"


class RTB_MT_emission(SpectrumMenu, bpy.types.Menu):
    """What a mesh sends out"""

    bl_idname = "RTB_MT_emission"
    field = "EMISSION"


class RTB_MT_cell(SpectrumMenu, bpy.types.Menu):
    """What a condition says"""

    bl_idname = "RTB_MT_cell"
    field = "CELL"


MENUS = {
    kind.field: kind
    for kind in (RTB_MT_reflectance, RTB_MT_light, RTB_MT_world, RTB_MT_emission, RTB_MT_cell)
}


def draw_in_context_menu(menu, context):
    """The menu of a right click on a field."""
    clicked, pointer = getattr(context, "button_prop", None), getattr(context, "button_pointer", None)
    field = field_of(pointer, clicked.identifier) if clicked is not None and pointer is not None else None
    if field is not None:
        menu.layout.separator()
        menu.layout.operator(RTB_OT_vary_in_recipe.bl_idname, icon="SPREADSHEET").field = field


def register() -> None:
    """Add our entry to the menu of a right click."""
    bpy.types.UI_MT_button_context_menu.append(draw_in_context_menu)


def unregister() -> None:
    """Take it back."""
    bpy.types.UI_MT_button_context_menu.remove(draw_in_context_menu)
