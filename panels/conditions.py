"""3D Viewport > Sidebar > RenderToolbox: the table of conditions."""

import bpy

from ..operators import row_states, running, thumbnails
from ..operators.add_condition import RTB_OT_add_condition
from ..operators.add_variable import RTB_OT_add_variable
from ..operators.move_condition import RTB_OT_move_condition
from ..operators.remove_condition import RTB_OT_remove_condition
from ..operators.select_variable import RTB_OT_select_variable
from ..operators.show_condition import RTB_OT_show_condition
from ..operators.turn_page import RTB_OT_turn_page
from ..rtb_addon.blender import preview
from .cells import draw_cell, draw_wide_cell
from .condition_menus import RTB_MT_conditions
from .sentences import draw_sentences

CELL = 66  # narrowest cell in which a word can be read [pixels at scale 1]
BESIDE = 52  # what borders and the buttons at the right take [pixels at scale 1]
ROWS = 6
ICONS = {"running": "TIME", "done": "CHECKMARK", "unchecked": "CHECKMARK", "": "RADIOBUT_OFF"}
ICONS |= {"failed": "ERROR", "changed": "FILE_REFRESH"}


class RTB_UL_conditions(bpy.types.UIList):
    """The rows of the table; those columns that the page shows"""

    bl_idname = "RTB_UL_conditions"

    def draw_item(self, context, layout, owner, item, icon, active, active_property, index):
        row, scene = layout.row(align=True), context.scene
        if row_states.known(scene):
            draw_state(row, scene, item, index)
            row.separator(factor=0.3)
        name = row_states.row_name(scene, item, index)
        row.prop(item, "name", text="", emboss=False, placeholder=name)
        for number in columns_shown(context):
            if number < len(item.cells):
                draw_cell(row, item.cells[number], scene.rtb.variables[number].kind)
            else:
                row.label(text="")


class RTB_PT_conditions(bpy.types.Panel):
    """What varies from one rendering to the next: a row for each of them"""

    bl_idname = "RTB_PT_conditions"
    bl_label = "Conditions"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "RenderToolbox"

    def draw(self, context):
        settings = context.scene.rtb
        self.layout.use_property_decorate = False
        if not len(settings.conditions) and not len(settings.variables):
            draw_beginning(self.layout)
            return
        column = self.layout.column(align=True)
        draw_header(column, context, settings)
        draw_rows(column, settings)
        draw_active_cell(self.layout, settings)
        draw_preview(self.layout, context)


def columns_shown(context) -> range:
    """Return the columns that fit into the sidebar, from the first one of the page."""
    scale = bpy.context.preferences.system.ui_scale or 1.0  # 0 where there is no window
    fit = max(int((context.region.width / scale - BESIDE) / CELL) - 1, 1)
    count = len(context.scene.rtb.variables)
    first = min(context.window_manager.rtb_first_variable, max(count - fit, 0))
    return range(first, min(first + fit, count))


def draw_state(layout, scene, row, index: int) -> None:
    """Draw how a row is: an icon, its rendering where that is of the row, or how far it is."""
    state, name = row_states.state(scene, row, index), row_states.row_name(scene, row, index)
    under_way = {} if running.batch is None else running.batch.under_way
    if state == "running" and name in under_way:
        layout.progress(factor=under_way[name], type="RING")
        return
    cell = layout.row(align=True)
    cell.active, cell.alert = state not in ("", "unchecked"), state == "failed"
    picture = 0
    if state in ("done", "unchecked"):
        picture = thumbnails.icon(scene, name, row_states.version(scene, name), dim=state == "unchecked")
        cell.active = cell.active or picture > 0  # which is dim by itself
    shown = {"icon_value": picture} if picture else {"icon": ICONS[state]}
    cell.operator(RTB_OT_show_condition.bl_idname, text="", emboss=False, **shown).condition = name


def draw_preview(layout, context) -> None:
    """Draw the switch of the preview, and what of it cannot be shown."""
    window_manager = context.window_manager
    shown = preview.is_on()
    layout.prop(window_manager, "rtb_preview", toggle=True, icon="HIDE_OFF" if shown else "HIDE_ON")
    draw_sentences(layout, preview.problems() if shown else [], context.region.width, alert=True)


def draw_beginning(layout) -> None:
    """Draw what to do with a scene that has no table yet."""
    column = layout.column(align=True)
    column.operator(RTB_OT_add_variable.bl_idname, icon="ADD")
    column.menu(RTB_MT_conditions.bl_idname, text="More Ways to Begin")


def draw_header(layout, context, settings) -> None:
    """Draw the names of the columns, and arrows where there are more of them."""
    shown = columns_shown(context)
    outer = layout.row(align=True)
    names = outer.row(align=True)
    if row_states.known(context.scene):
        names.label(text="", icon="BLANK1")
        names.separator(factor=0.3)
    names.label(text="Name")
    for number in shown:
        active = number == settings.active_variable
        button = names.operator(
            RTB_OT_select_variable.bl_idname, text=settings.variables[number].name, depress=active
        )
        button.index = number
    draw_arrow(outer, "TRIA_LEFT", max(shown.start - len(shown), 0), shown.start > 0)
    draw_arrow(outer, "TRIA_RIGHT", shown.stop, shown.stop < len(settings.variables))


def draw_arrow(layout, icon: str, first: int, possible: bool) -> None:
    """Draw an arrow that turns the page to its first column, grey where there is none."""
    side = layout.row(align=True)
    side.enabled = possible
    side.operator(RTB_OT_turn_page.bl_idname, text="", icon=icon).first = first


def draw_rows(layout, settings) -> None:
    """Draw the list, and at its right what can be done with rows."""
    row = layout.row()
    row.template_list(
        RTB_UL_conditions.bl_idname, "", settings, "conditions", settings, "active_condition", rows=ROWS
    )
    side = row.column(align=True)
    side.operator(RTB_OT_add_condition.bl_idname, text="", icon="ADD")
    side.operator(RTB_OT_remove_condition.bl_idname, text="", icon="REMOVE")
    side.separator()
    side.menu(RTB_MT_conditions.bl_idname, text="", icon="DOWNARROW_HLT")
    side.separator()
    side.operator(RTB_OT_move_condition.bl_idname, text="", icon="TRIA_UP").by = -1
    side.operator(RTB_OT_move_condition.bl_idname, text="", icon="TRIA_DOWN").by = 1


def draw_active_cell(layout, settings) -> None:
    """Draw the active row's cell of the active variable, as wide as the sidebar."""
    row, number = settings.active_condition, settings.active_variable
    if row < len(settings.conditions) and number < len(settings.conditions[row].cells):
        variable = settings.variables[number]
        layout.label(text=variable.name)
        draw_wide_cell(layout, settings.conditions[row].cells[number], variable.kind)
