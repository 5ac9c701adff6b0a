"""What can be done with the table of conditions beyond a click: the menus of its rows and columns."""

import bpy

from ..operators.add_variable import RTB_OT_add_variable
from ..operators.copy_conditions import RTB_OT_copy_conditions
from ..operators.duplicate_condition import RTB_OT_duplicate_condition
from ..operators.duplicate_variable import RTB_OT_duplicate_variable
from ..operators.export_conditions import RTB_OT_export_conditions
from ..operators.fill_from_library import RTB_OT_fill_from_library
from ..operators.fill_graded import RTB_OT_fill_graded
from ..operators.fill_grid import RTB_OT_fill_grid
from ..operators.fill_list import RTB_OT_fill_list
from ..operators.fill_pairs import RTB_OT_fill_pairs
from ..operators.fill_random import RTB_OT_fill_random
from ..operators.fill_range import RTB_OT_fill_range
from ..operators.import_conditions import RTB_OT_import_conditions
from ..operators.move_variable import RTB_OT_move_variable
from ..operators.paste_conditions import RTB_OT_paste_conditions
from ..operators.remove_variable import RTB_OT_remove_variable
from ..operators.rename_variable import RTB_OT_rename_variable
from ..operators.select_variable import MENU
from ..operators.set_variable_kind import RTB_OT_set_variable_kind

DESIGNS = (
    RTB_OT_fill_from_library,
    RTB_OT_fill_list,
    RTB_OT_fill_range,
    RTB_OT_fill_grid,
    RTB_OT_fill_random,
    RTB_OT_fill_graded,
    RTB_OT_fill_pairs,
)


class RTB_MT_designs(bpy.types.Menu):
    """Rows by a rule"""

    bl_idname = "RTB_MT_designs"
    bl_label = "Fill In"

    def draw(self, context):
        self.layout.operator_context = "INVOKE_DEFAULT"
        for verb in DESIGNS:
            self.layout.operator(verb.bl_idname, text=f"{verb.bl_label}…")


class RTB_MT_variable(bpy.types.Menu):
    """What can be done with the active variable"""

    bl_idname = MENU
    bl_label = "Variable"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator(RTB_OT_add_variable.bl_idname, text="Add Variable…", icon="ADD")
        layout.operator(RTB_OT_rename_variable.bl_idname, text="Rename Variable…")
        layout.operator_menu_enum(RTB_OT_set_variable_kind.bl_idname, "kind")
        layout.operator(RTB_OT_duplicate_variable.bl_idname, icon="DUPLICATE")
        layout.operator(RTB_OT_move_variable.bl_idname, text="Move Left", icon="TRIA_LEFT").by = -1
        layout.operator(RTB_OT_move_variable.bl_idname, text="Move Right", icon="TRIA_RIGHT").by = 1
        layout.separator()
        layout.operator(RTB_OT_remove_variable.bl_idname, icon="REMOVE")


class RTB_MT_conditions(bpy.types.Menu):
    """What can be done with the whole table"""

    bl_idname = "RTB_MT_conditions"
    bl_label = "Conditions"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator(RTB_OT_duplicate_condition.bl_idname, icon="DUPLICATE")
        layout.menu(RTB_MT_designs.bl_idname)
        layout.menu(RTB_MT_variable.bl_idname)
        layout.separator()
        layout.operator(RTB_OT_copy_conditions.bl_idname, text="Copy to Spreadsheet", icon="COPYDOWN")
        layout.operator(RTB_OT_paste_conditions.bl_idname, text="Paste from Spreadsheet", icon="PASTEDOWN")
        layout.separator()
        layout.operator(RTB_OT_import_conditions.bl_idname, text="Import…", icon="IMPORT")
        layout.operator(RTB_OT_export_conditions.bl_idname, text="Export…", icon="EXPORT")
