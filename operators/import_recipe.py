"""Open a recipe: its folder or zip, or the files of RenderToolbox3 and 4."""

from pathlib import Path

import bpy
from bpy_extras.io_utils import ImportHelper

from ..rtb_addon.errors import RecipeError
from . import findings

ENDINGS = ".dae;.zae;.zip;.json;.txt"


class RTB_OT_import_recipe(bpy.types.Operator, ImportHelper):
    """Open a recipe in a new scene: its recipe.json or zip, or a Collada file with conditions and mappings"""

    bl_idname = "rtb.import_recipe"
    bl_label = "Import Recipe"
    bl_options = {"REGISTER", "UNDO"}

    filter_glob: bpy.props.StringProperty(default=ENDINGS.replace(".", "*."), options={"HIDDEN"})
    files: bpy.props.CollectionProperty(
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    directory: bpy.props.StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})
    output: bpy.props.StringProperty(
        name="Recipe Folder",
        description="For the recipe of old files or a zip; empty: beside them, called after them",
        subtype="DIR_PATH",
        options={"SKIP_SAVE"},
    )
    convention: bpy.props.EnumProperty(
        name="Convention",
        items=(
            ("si", "SI", "A point light's number is W / (sr nm)", 1),
            ("rtb3", "RenderToolbox3", "Light spectra are total power, as they were", 2),
        ),
        description="What the numbers of old files mean",
    )

    def invoke(self, context, event):
        dropped = any(each.name for each in self.files)
        return self.execute(context) if dropped else super().invoke(context, event)

    def execute(self, context):
        # This brings much that enabling need not wait for.
        from ..rtb_addon.blender.imported_recipe import open_recipe

        chosen = [Path(self.directory) / each.name for each in self.files if each.name]
        chosen = chosen or [Path(bpy.path.abspath(self.filepath))]
        try:
            folder, odd = self.folder_of(chosen)
            scenes, left_out = open_recipe(folder)
        except RecipeError as error:
            return findings.refuse(self, error)
        if context.window is not None:
            context.window.scene = scenes[0]
        findings.clear()
        findings.note(others=[*odd, *left_out])
        names = ", ".join(each.rtb.name for each in scenes)
        self.report(
            {"INFO"}, f"Open in {'scenes of their own' if len(scenes) > 1 else 'a scene of its own'}: {names}"
        )
        return {"FINISHED"}

    def folder_of(self, chosen: list[Path]) -> tuple[Path, list[str]]:
        """Return the folder of the recipe that files are, made where it must be, and what was odd."""
        first = chosen[0]
        if first.is_dir() or first.name == "recipe.json":
            return (first if first.is_dir() else first.parent), []
        if first.suffix.lower() == ".zip":
            from ..rtb_addon.recipe.unpacking import unpack_recipe

            return unpack_recipe(first, self.new_folder(first)).folder, []
        from ..rtb_addon.old_recipes import import_recipe

        parent, conditions, mappings = sorted_out(chosen)
        folder = self.new_folder(parent)
        _, odd = import_recipe(parent, conditions, mappings, folder, units=self.convention)
        return folder, odd

    def new_folder(self, file: Path) -> Path:
        """Return where a recipe's folder is to be made."""
        said = self.output.strip()
        folder = Path(bpy.path.abspath(said)) if said else file.with_name(f"{file.stem} recipe")
        if folder.exists() and any(folder.iterdir()):
            raise RecipeError(f"the folder {folder} is there already, choose another one or open it")
        return folder


def sorted_out(chosen: list[Path]) -> tuple[Path, Path | None, Path | None]:
    """Return which of old files is the parent scene, the conditions, the mappings; one of each at most."""
    found: dict[str, list[Path]] = {"parent": [], "conditions": [], "mappings": []}
    for file in chosen:
        found[_kind(file)].append(file)
    for kind, files in found.items():
        if len(files) > 1:
            raise RecipeError(f"{files[0].name} and {files[1].name} are both {kind}, choose one of them")
    if not found["parent"]:
        raise RecipeError("choose a Collada file (.dae), with its conditions and mappings, or a recipe.json")
    one = {kind: files[0] if files else None for kind, files in found.items()}
    assert one["parent"] is not None
    return one["parent"], one["conditions"], one["mappings"]


def _kind(file: Path) -> str:
    """Return what an old file is: mappings hold braces, tables do not."""
    if file.suffix.lower() in (".dae", ".zae"):
        return "parent"
    if file.suffix.lower() == ".json":
        return "mappings"
    try:
        return "mappings" if b"{" in file.read_bytes() else "conditions"
    except OSError as error:
        raise RecipeError(f"cannot read {file}: {error.strerror}") from error
