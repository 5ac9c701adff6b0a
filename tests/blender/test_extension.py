"""Enabling and disabling the extension."""

import gc
import subprocess
import threading
from pathlib import Path

import bpy

OWNERS = ("Scene", "Material", "Light", "World", "Object", "WindowManager")
SMALL_WORDS = ("In", "As", "Of", "To")


def traces() -> dict[str, object]:
    """Return everything in which an extension could leave something of itself."""
    handlers = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    configurations = bpy.context.window_manager.keyconfigs
    keymaps = configurations.addon.keymaps if configurations.addon is not None else ()
    return {
        "classes": {name for name in dir(bpy.types) if name.startswith(("RTB", "rtb"))},
        "properties": {
            f"{owner}.{name}"
            for owner in OWNERS
            for name in dir(getattr(bpy.types, owner))
            if name[:3] == "rtb"
        },
        "handlers": {name: ours(found) for name, found in handlers.items() if isinstance(found, list)},
        "menus": {name: count for name in dir(bpy.types) if (count := ours(drawn_by(name)))},
        "panels": {
            panel.__name__
            for panel in bpy.types.Panel.__subclasses__()
            if "RENDERTOOLBOX" in getattr(panel, "COMPAT_ENGINES", ())
        },
        "operators": set(dir(bpy.ops.rtb)),
        "keys": {
            item.idname for keymap in keymaps for item in keymap.keymap_items if item.idname[:4] == "rtb."
        },
        "libraries": [each.name for each in bpy.context.preferences.filepaths.asset_libraries],
        "tools": tools(),
    }


def ours(functions) -> int:
    """Return how many functions are the extension's."""
    return sum("render_toolbox" in getattr(each, "__module__", "") for each in functions)


def drawn_by(name: str) -> list:
    """Return what draws a panel, menu or header of Blender's."""
    kind = getattr(bpy.types, name)
    return (
        kind._dyn_ui_initialize()
        if isinstance(kind, type) and hasattr(kind.__dict__.get("draw"), "_draw_funcs")
        else []
    )


def tools() -> set[str]:
    """Return the extension's tools in the toolbar of the Image Editor."""
    from bl_ui.space_toolsystem_toolbar import IMAGE_PT_tools_active

    found = IMAGE_PT_tools_active.tools_from_context(bpy.context, "VIEW")
    return {
        each.idname for each in found if each is not None and hasattr(each, "idname") and "rtb" in each.idname
    }


def left_running() -> list[str]:
    """Return the extension's child processes that are alive, and the threads that listen to them."""
    gc.collect()
    children = [
        each for each in gc.get_objects() if isinstance(each, subprocess.Popen) and each.poll() is None
    ]
    listening = [
        each for each in threading.enumerate() if "rtb_addon" in repr(getattr(each, "_target", None))
    ]
    return [" ".join(each.args) for each in children if "rtb_addon" in each.args] + [
        str(each) for each in listening
    ]


def test_enabling_shows_everything_and_disabling_leaves_nothing_behind(extension):
    import addon_utils

    enabled = traces()
    assert {name.split(".")[0] for name in enabled["properties"]} == set(OWNERS)
    assert {"export_recipe", "render_recipe", "cancel_rendering", "show_montage"} <= enabled["operators"]
    assert {"TOPBAR_MT_file_export", "TOPBAR_MT_render", "STATUSBAR_HT_header"} <= set(enabled["menus"])
    assert enabled["handlers"]["load_pre"] > 0
    assert enabled["panels"]
    assert enabled["tools"]
    addon_utils.disable(extension)
    disabled = traces()
    assert not any(disabled["handlers"].values())
    for name in ("classes", "properties", "menus", "panels", "operators", "keys", "tools"):
        assert not disabled[name], name
    assert addon_utils.enable(extension) is not None
    assert traces() == enabled
    addon_utils.disable(extension)
    assert traces() == disabled
    addon_utils.enable(extension)
    assert traces() == enabled


def test_disabling_ends_what_is_rendered_checked_and_looked_at(family, extension, module):
    import addon_utils

    bpy.ops.rtb.render_recipe()
    family.rtb.samples = 1_000_000
    bpy.ops.rtb.export_recipe()
    module("operators.running").start(Path(bpy.path.abspath("//rtb/cube")))
    assert left_running()
    addon_utils.disable(extension)
    try:
        assert left_running() == []
    finally:
        addon_utils.enable(extension, default_set=True)
    assert bpy.context.scene.rtb.samples == 1_000_000


def test_every_name_begins_with_ours_and_every_tooltip_is_a_sentence_without_full_stop(extension):
    for name in dir(bpy.ops.rtb):
        kind = getattr(bpy.ops.rtb, name).get_rna_type()
        assert kind.description
        assert not kind.description.endswith(".")
        title = kind.name.title()
        for word in SMALL_WORDS:
            title = title.replace(f" {word} ", f" {word.lower()} ")
        assert kind.name == title
