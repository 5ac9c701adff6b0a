"""Enabling and disabling the extension."""

import bpy

MENUS = ("TOPBAR_MT_file_export", "TOPBAR_MT_render", "STATUSBAR_HT_header")
OWNERS = ("Scene", "Material", "Light", "World", "Object")


def traces() -> dict[str, object]:
    """Return everything in which an extension could leave something of itself."""
    handlers = {name: getattr(bpy.app.handlers, name) for name in dir(bpy.app.handlers)}
    return {
        "classes": {name for name in dir(bpy.types) if name.startswith(("RTB", "rtb"))},
        "properties": {owner for owner in OWNERS if hasattr(getattr(bpy.types, owner), "rtb")},
        "handlers": {name: ours(found) for name, found in handlers.items() if isinstance(found, list)},
        "menus": {name: len(getattr(bpy.types, name)._dyn_ui_initialize()) for name in MENUS},
        "operators": set(dir(bpy.ops.rtb)),
    }


def ours(handlers: list) -> int:
    """Return how many handlers are functions of the extension."""
    return sum("render_toolbox" in getattr(handler, "__module__", "") for handler in handlers)


def test_enabling_shows_everything_and_disabling_leaves_nothing_behind(extension):
    import addon_utils

    enabled = traces()
    assert len(enabled["properties"]) == len(OWNERS)
    assert {"export_recipe", "render_recipe", "cancel_rendering", "show_montage"} <= enabled["operators"]
    addon_utils.disable(extension)
    disabled = traces()
    assert not disabled["classes"]
    assert not disabled["properties"]
    assert not disabled["operators"]
    for name in MENUS:
        assert disabled["menus"][name] == enabled["menus"][name] - 1
    assert enabled["handlers"]["load_pre"] > 0
    assert not any(disabled["handlers"].values())
    assert addon_utils.enable(extension) is not None
    assert traces() == enabled
    addon_utils.disable(extension)
    assert traces() == disabled
    addon_utils.enable(extension)
    assert traces() == enabled


def test_every_name_begins_with_ours_and_every_tooltip_is_a_sentence_without_full_stop(extension):
    for name in dir(bpy.ops.rtb):
        kind = getattr(bpy.ops.rtb, name).get_rna_type()
        assert kind.description
        assert not kind.description.endswith(".")
        assert kind.name == kind.name.title().replace(" In ", " in ").replace(" As ", " as ")
