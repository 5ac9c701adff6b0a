"""How far two renderers' cubes of a scene's recipe lie apart."""

from __future__ import annotations

import json

import bpy

from ..rtb_addon.blender.folders import recipe_folder
from ..rtb_addon.blender.properties import RENDERERS
from ..rtb_addon.errors import RecipeError
from . import findings
from .child_verb import ChildVerb, Ended
from .tell import tell


class RTB_OT_compare_renderers(bpy.types.Operator):
    """Say how far the renderings of two renderers lie apart; difference cubes go into the recipe's folder"""

    bl_idname = "rtb.compare_renderers"
    bl_label = "Compare"
    bl_options = {"REGISTER"}

    first: bpy.props.EnumProperty(name="Renderer", items=RENDERERS, default="mitsuba")
    second: bpy.props.EnumProperty(name="Against", items=RENDERERS, default="tracer")

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self, confirm_text="Compare")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(self, "first")
        self.layout.prop(self, "second")

    def execute(self, context):
        try:
            folder = recipe_folder(context.scene)
        except RecipeError as error:
            return findings.refuse(self, error)
        ended: list[Ended] = []
        renderers = f"{self.first},{self.second}"
        child = ["compare", str(folder), "--renderers", renderers, "--json"]
        ChildVerb(child, ended.append if bpy.app.background else _tell)
        if ended and ended[0].status:
            return findings.refuse(self, RecipeError(ended[0].complaints[-1]))
        if ended:
            _note(ended[0])
            self.report({"INFO"}, findings.remarks[-1])
        return {"FINISHED"}


def _tell(ended: Ended) -> None:
    """Tell how far they lie apart, where a window was kept alive meanwhile."""
    findings.clear()
    if ended.status:
        findings.note(ended.complaints[-1:])
        tell("ERROR", ended.complaints[-1] if ended.complaints else "comparing ended without a word")
        return
    _note(ended)
    tell("INFO", "Compared: see the recipe's panel")


def _note(ended: Ended) -> None:
    rows = [json.loads(line) for line in ended.lines if line.startswith("{")]
    findings.note(others=[_sentence(row) for row in rows])


def _sentence(row: dict[str, str]) -> str:
    apart = f"they differ by {float(row['relative rms']):.2%} (rms)"
    noise = f", of which noise explains {float(row['noise']):.2%}" if row["noise"] else ""
    return f"{row['condition']}: the means' ratio is {row['ratio']}, {apart}{noise}"
