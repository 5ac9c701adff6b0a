"""Find out which renderers are installed."""

from __future__ import annotations

import json

import bpy

from ..rtb_addon.blender.redrawing import redraw_panels
from ..rtb_addon.blender.renderer_choices import OURS, learn
from . import renderers_found
from .child_verb import ChildVerb, Ended
from .preferred import preferences


class RTB_OT_test_renderers(bpy.types.Operator):
    """Find out which renderers are installed, in which version, and why one is not"""

    bl_idname = "rtb.test_renderers"
    bl_label = "Test Renderers"
    bl_options = {"REGISTER"}

    def execute(self, context):
        renderers_found.found.clear()
        ChildVerb(["renderers", "--json"], _take)
        if bpy.app.background:
            there = [name for name, each in renderers_found.found.items() if each.version]
            self.report({"INFO"}, f"Renderers that are here: {', '.join(there) or 'none'}")
        return {"FINISHED"}


def _take(ended: Ended) -> None:
    """Take in what the child has found; what other packages bring is offered from now on."""
    for line in ended.lines:
        words = json.loads(line)
        renderers_found.found[words["renderer"]] = renderers_found.Found(words["version"], words["reason"])
    others = [name for name in renderers_found.found if name not in OURS]
    learn(others)
    if (chosen := preferences()) is not None:
        chosen.others = " ".join(others)
    redraw_panels()
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "PREFERENCES":
                area.tag_redraw()
