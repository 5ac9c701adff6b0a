"""The ways to say a spectrum: a menu beside each field that holds one, and in its context menu."""

import bpy

from ..operators.import_spectra import RTB_OT_import_spectra
from ..operators.use_colour import RTB_OT_use_colour
from ..operators.use_curve import RTB_OT_use_curve
from ..operators.use_flat_spectrum import RTB_OT_use_flat_spectrum
from ..operators.use_library_spectrum import RTB_OT_use_library_spectrum
from ..operators.use_spectrum_file import RTB_OT_use_spectrum_file
from ..operators.use_table import RTB_OT_use_table
from ..operators.use_temperature import RTB_OT_use_blackbody, RTB_OT_use_daylight
from ..operators.use_variable import RTB_OT_use_variable
from ..operators.vary_in_recipe import RTB_OT_vary_in_recipe
from ..rtb_addon.blender.fields import FIELDS, field_of

INDICES = (RTB_OT_use_flat_spectrum, RTB_OT_use_table, RTB_OT_use_curve)
ANY = (
    RTB_OT_use_flat_spectrum,
    RTB_OT_use_daylight,
    RTB_OT_use_blackbody,
    RTB_OT_use_colour,
    RTB_OT_use_table,
    RTB_OT_use_curve,
)


def draw_menu(row, field: str) -> None:
    """Draw the button of the menu beside a field, which it is told of as menus take no arguments."""
    row.context_string_set("rtb_field", field)
    row.menu(RTB_MT_spectrum.bl_idname, text="", icon="DOWNARROW_HLT")


class RTB_MT_spectrum(bpy.types.Menu):
    """Ways to say this spectrum"""

    bl_idname = "RTB_MT_spectrum"
    bl_label = "Spectrum"

    def draw(self, context):
        field = getattr(context, "rtb_field", "CELL")
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator(RTB_OT_use_library_spectrum.bl_idname, text="Library…", icon="VIEWZOOM").field = field
        layout.operator(RTB_OT_use_spectrum_file.bl_idname, text="File…", icon="FILEBROWSER").field = field
        layout.operator(RTB_OT_import_spectra.bl_idname, text="Import to Library…", icon="IMPORT")
        layout.separator()
        for verb in INDICES if FIELDS[field].index else ANY:
            layout.operator(verb.bl_idname, text=f"{verb.bl_label}…").field = field
        layout.separator()
        layout.prop_menu_enum(context.scene.rtb, "seen_under")
        if field != "CELL":
            layout.separator()
            self.draw_variables(layout, context.scene.rtb, field)

    def draw_variables(self, layout, settings, field):
        """Draw what the conditions may say."""
        for variable in settings.variables:
            entry = layout.operator(RTB_OT_use_variable.bl_idname, text=f"Variable ({variable.name})")
            entry.field, entry.variable = field, variable.name
        layout.operator(RTB_OT_vary_in_recipe.bl_idname, text="New Variable").field = field


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
