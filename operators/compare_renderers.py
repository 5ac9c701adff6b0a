"""How far two renderers' cubes of a scene's recipe lie apart."""

import json
from functools import partial
from pathlib import Path

import bpy

from ..rtb_addon.blender.folders import recipe_name, written_folder
from ..rtb_addon.blender.renderer_choices import choices
from ..rtb_addon.errors import RecipeError
from . import findings, montages
from .child_verb import ChildVerb, Ended
from .tell import tell


class RTB_OT_compare_renderers(bpy.types.Operator):
    """Say how far the renderings of two renderers lie apart; difference cubes go into the recipe's folder"""

    bl_idname = "rtb.compare_renderers"
    bl_label = "Compare"
    bl_options = {"REGISTER"}

    first: bpy.props.EnumProperty(name="Renderer", items=choices, default=1)
    second: bpy.props.EnumProperty(name="Against", items=choices, default=2)

    def invoke(self, context, event):
        return context.window_manager.invoke_props_dialog(self, confirm_text="Compare")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(self, "first")
        self.layout.prop(self, "second")

    def execute(self, context):
        try:
            folder = written_folder(context.scene)
        except RecipeError as error:
            return findings.refuse(self, error)
        ended: list[Ended] = []
        picture = comparison_picture(folder, context.scene, self.first, self.second)
        child = ["compare", str(folder), "--renderers", f"{self.first},{self.second}", "--json"]
        ChildVerb(child, ended.append if bpy.app.background else partial(_tell, picture), of_file=True)
        if ended and ended[0].status:
            return findings.refuse(self, RecipeError(ended[0].last_words("comparing")))
        if ended:
            _note(ended[0], picture)
            self.report({"INFO"}, findings.remarks[-1])
        return {"FINISHED"}


def comparison_picture(folder: Path, scene, first: str, second: str) -> Path:
    """Return the file that comparing two renderers draws their difference into."""
    return folder / "comparisons" / f"{first}-{second}" / f"{recipe_name(scene)}.png"


def _tell(picture: Path, ended: Ended) -> None:
    """Tell how far they lie apart, where a window was kept alive meanwhile."""
    findings.clear()
    if ended.status:
        findings.note([ended.last_words("comparing")])
        tell("ERROR", ended.last_words("comparing"))
        return
    image = _note(ended, picture)
    if (area := montages.editor(bpy.context)) is not None:
        montages.show(image, area)
    tell("INFO", f"Compared: see the recipe's panel, and the image {image.name}")


def _note(ended: Ended, picture: Path) -> bpy.types.Image:
    """Take in the numbers, a sentence each, and the picture in false colours."""
    rows = [json.loads(line) for line in ended.lines if line.startswith("{")]
    findings.note(others=[_sentence(row) for row in rows])
    return montages.load(picture, f"{picture.stem} {picture.parent.name}")


def _sentence(row: dict[str, str]) -> str:
    apart = f"they differ by {float(row['relative rms']):.2%} (rms)"
    noise = f", of which noise explains {float(row['noise']):.2%}" if row["noise"] else ""
    return f"{row['condition']}: the means' ratio is {row['ratio']}, {apart}{noise}"
