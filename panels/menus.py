"""Where the operators stand in Blender's own menus, so that F3 finds them, and the key that stops a batch."""

import bpy

from ..operators.cancel_rendering import RTB_OT_cancel_rendering
from ..operators.export_recipe import RTB_OT_export_recipe
from ..operators.render_recipe import RTB_OT_render_recipe
from ..operators.show_montage import RTB_OT_show_montage


def draw_in_export(menu, context):
    """File > Export."""
    menu.layout.operator(RTB_OT_export_recipe.bl_idname, text="RenderToolbox Recipe (folder)")


def draw_in_render(menu, context):
    """The Render menu."""
    layout = menu.layout
    layout.separator()
    layout.operator(RTB_OT_render_recipe.bl_idname, icon="RENDER_STILL")
    layout.operator(RTB_OT_cancel_rendering.bl_idname)
    layout.operator(RTB_OT_show_montage.bl_idname, icon="IMAGE_DATA")


_keys = []


def register() -> None:
    """Add our entries."""
    bpy.types.TOPBAR_MT_file_export.append(draw_in_export)
    bpy.types.TOPBAR_MT_render.append(draw_in_render)
    # Without a window there are no keys. Esc comes here while a batch runs, when nothing else wants it.
    if (configuration := bpy.context.window_manager.keyconfigs.addon) is not None:
        keymap = configuration.keymaps.new(name="Window", space_type="EMPTY")
        _keys.append((keymap, keymap.keymap_items.new(RTB_OT_cancel_rendering.bl_idname, "ESC", "PRESS")))


def unregister() -> None:
    """Take our entries back."""
    for keymap, item in _keys:
        keymap.keymap_items.remove(item)
    _keys.clear()
    bpy.types.TOPBAR_MT_render.remove(draw_in_render)
    bpy.types.TOPBAR_MT_file_export.remove(draw_in_export)
