"""Drawing panels anew after a change that Blender does not notice by itself."""

import bpy

PANELS = {("PROPERTIES", "WINDOW"), ("VIEW_3D", "UI"), ("IMAGE_EDITOR", "UI")}


def redraw_panels() -> None:
    """Let the properties and the sidebars be drawn anew, but not the scene, which may take long."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if (area.type, region.type) in PANELS:
                    region.tag_redraw()
