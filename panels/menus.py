"""Where the operators stand in Blender's own menus, so that F3 finds them, and the key that stops a batch."""

import bpy

from ..operators.add_condition import RTB_OT_add_condition
from ..operators.cancel_rendering import RTB_OT_cancel_rendering
from ..operators.check_recipe import RTB_OT_check_recipe
from ..operators.compare_renderers import RTB_OT_compare_renderers
from ..operators.edit_mappings_text import RTB_OT_edit_mappings_text
from ..operators.export_recipe import RTB_OT_export_recipe
from ..operators.import_recipe import RTB_OT_import_recipe
from ..operators.import_spectra import RTB_OT_import_spectra
from ..operators.open_folder import RTB_OT_open_folder
from ..operators.pack_recipe import RTB_OT_pack_recipe
from ..operators.preview_condition import RTB_OT_preview_condition
from ..operators.render_condition import RTB_OT_render_condition
from ..operators.render_recipe import RTB_OT_render_recipe
from ..operators.show_montage import RTB_OT_show_montage
from ..operators.show_still import RTB_OT_show_still
from ..operators.vary_property import RTB_OT_vary_property
from ..rtb_addon.blender import mapping_edits
from ..rtb_addon.blender.fields import field_of
from .condition_menus import RTB_MT_conditions

IN_RECIPE = (
    RTB_OT_check_recipe,
    RTB_OT_preview_condition,
    RTB_OT_show_montage,
    RTB_OT_show_still,
    RTB_OT_edit_mappings_text,
    RTB_OT_open_folder,
)
ASKING = (RTB_OT_compare_renderers, RTB_OT_pack_recipe)


class RTB_MT_recipe(bpy.types.Menu):
    """What can be done with the recipe and its table"""

    bl_idname = "RTB_MT_recipe"
    bl_label = "Recipe"

    def draw(self, context):
        layout = self.layout
        for verb in IN_RECIPE:
            layout.operator(verb.bl_idname)
        layout.operator_context = "INVOKE_DEFAULT"
        for verb in ASKING:
            layout.operator(verb.bl_idname, text=f"{verb.bl_label}…")
        layout.separator()
        layout.operator(RTB_OT_add_condition.bl_idname, icon="ADD")
        layout.menu(RTB_MT_conditions.bl_idname)


def draw_in_export(menu, context):
    """File > Export."""
    menu.layout.operator_context = "INVOKE_DEFAULT"
    menu.layout.operator(RTB_OT_pack_recipe.bl_idname, text="RenderToolbox Recipe (.zip)")
    menu.layout.operator(RTB_OT_export_recipe.bl_idname, text="RenderToolbox Recipe (folder)")


def draw_in_import(menu, context):
    """File > Import."""
    menu.layout.operator(RTB_OT_import_recipe.bl_idname, text="RenderToolbox Recipe (.dae/.json/.zip)")
    menu.layout.operator(RTB_OT_import_spectra.bl_idname, text="RenderToolbox Spectra (.spd/.csv/.mat)")


def draw_in_render(menu, context):
    """The Render menu."""
    layout = menu.layout
    layout.separator()
    layout.operator(RTB_OT_render_recipe.bl_idname, icon="RENDER_STILL")
    layout.operator(RTB_OT_render_condition.bl_idname)
    layout.operator(RTB_OT_cancel_rendering.bl_idname)
    layout.menu(RTB_MT_recipe.bl_idname)


def draw_in_context_menu(menu, context):
    """The menu of a right click on a property; spectra have an entry of their own."""
    clicked, struct = getattr(context, "button_prop", None), getattr(context, "button_pointer", None)
    if clicked is None or struct is None or field_of(struct, clicked.identifier) is not None:
        return
    if (found := mapping_edits.varying(struct, clicked)) is None:
        return
    thing, path = found
    menu.layout.separator()
    button = menu.layout.operator(RTB_OT_vary_property.bl_idname, icon="SPREADSHEET")
    button.home, button.thing, button.path = mapping_edits.home_of(thing), thing.name, path
    button.index = component(context, thing, path)


def component(context, thing, path: str) -> int:
    """Return which component of a vector was clicked, -1 where that is all of it."""
    said = getattr(context, "property", None)
    return said[2] if said is not None and said[1] == path and said[0] == thing else -1


_keys = []


def register() -> None:
    """Add our entries."""
    bpy.types.TOPBAR_MT_file_export.append(draw_in_export)
    bpy.types.TOPBAR_MT_file_import.append(draw_in_import)
    bpy.types.TOPBAR_MT_render.append(draw_in_render)
    bpy.types.UI_MT_button_context_menu.append(draw_in_context_menu)
    # Without a window there are no keys. Esc comes here while a batch runs, when nothing else wants it.
    if (configuration := bpy.context.window_manager.keyconfigs.addon) is not None:
        keymap = configuration.keymaps.new(name="Window", space_type="EMPTY")
        _keys.append((keymap, keymap.keymap_items.new(RTB_OT_cancel_rendering.bl_idname, "ESC", "PRESS")))


def unregister() -> None:
    """Take our entries back."""
    for keymap, item in _keys:
        keymap.keymap_items.remove(item)
    _keys.clear()
    bpy.types.UI_MT_button_context_menu.remove(draw_in_context_menu)
    bpy.types.TOPBAR_MT_render.remove(draw_in_render)
    bpy.types.TOPBAR_MT_file_import.remove(draw_in_import)
    bpy.types.TOPBAR_MT_file_export.remove(draw_in_export)
