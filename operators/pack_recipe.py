"""A scene's recipe in one file."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper

from ..rtb_addon.blender import read_recipe
from ..rtb_addon.errors import RecipeError
from . import findings
from .child_verb import ChildVerb, Ended
from .tell import tell


class RTB_OT_pack_recipe(bpy.types.Operator, ExportHelper):
    """Write the recipe with all files that it names into one zip, which others render without Blender"""

    bl_idname = "rtb.pack_recipe"
    bl_label = "Pack"
    bl_options = {"REGISTER"}

    filename_ext = ".zip"
    filter_glob: bpy.props.StringProperty(default="*.zip", options={"HIDDEN"})
    renderings: bpy.props.BoolProperty(
        name="Renderings", description="Take along what was rendered, else only what it takes to render it"
    )

    def execute(self, context):
        try:
            folder = findings.exported(read_recipe(context.scene))
        except RecipeError as error:
            return findings.refuse(self, error)
        file = Path(bpy.path.abspath(self.filepath))
        more = ["--renderings"] if self.renderings else []
        ended: list[Ended] = []
        ChildVerb(["pack", str(folder), str(file), *more], ended.append if bpy.app.background else _tell)
        if ended and ended[0].status:
            return findings.refuse(self, RecipeError(ended[0].last_words("packing")))
        if ended:
            findings.note(others=_left_behind(ended[0]))
            self.report({"INFO"}, f"Packed into {file}")
        return {"FINISHED"}


def _tell(ended: Ended) -> None:
    """Tell how packing went, where a window was kept alive meanwhile."""
    if ended.status:
        findings.note([ended.last_words("packing")])
        tell("ERROR", ended.last_words("packing"))
        return
    findings.note(others=_left_behind(ended))
    tell("INFO", f"Packed into {ended.lines[-1]}")


def _left_behind(ended: Ended) -> list[str]:
    return [each.removeprefix("warning: ") for each in ended.complaints]
