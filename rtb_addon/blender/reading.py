"""A Blender scene as a recipe: the last look at Blender before files and processes take over."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import bpy

from ..conditions import Conditions
from ..errors import RecipeError
from ..recipe import Conventions, MontageOptions, RecipeOptions, write_recipe
from ..scene.write_numbers import shortest
from .evaluation import as_rendered
from .folders import blend_folder, recipe_folder, recipe_name
from .parent import Parent, ParentWriter
from .seen import seen_in
from .table import SpectrumFiles, Table, mappings_text

_CAMERA = "camera"


@dataclass(frozen=True)
class SceneRecipe:
    """
    A recipe that a scene holds, ready to be written.

    Parameters
    ----------
    parent : the parent scene, Collada 1.4.1
    mappings : text of the mappings file
    resources : contents of files by their names below resources/
    report : what had to be assumed or is left out, a sentence each
    folder : where it is saved unless said otherwise; None while an unsaved .blend file leaves that open
    """

    name: str
    options: RecipeOptions
    montage: MontageOptions
    parent: bytes
    conditions: Conditions
    mappings: str
    resources: Mapping[str, bytes]
    provenance: Mapping[str, str]
    report: tuple[str, ...]
    folder: Path | None

    def save(self, folder: Path | str | None = None) -> Path:
        """Write the recipe into a folder, by default its own, and return that."""
        chosen = Path(folder) if folder is not None else self.folder
        if chosen is None:
            raise RecipeError("the recipe's folder is relative to the .blend file: save that first")
        write_recipe(
            chosen,
            self.name,
            self.options,
            Conventions(),
            self.montage,
            self.parent,
            self.conditions,
            self.mappings,
            self.resources,
            self.provenance,
        )
        return chosen


def read_recipe(scene: bpy.types.Scene) -> SceneRecipe:
    """Return the recipe of a scene as it renders at its current frame."""
    if scene.camera is None:
        raise RecipeError(f"the scene {scene.name} has no camera, add one")
    name = recipe_name(scene)
    seen = as_rendered(scene, seen_in)
    parent = ParentWriter(seen, scene.name, f"RenderToolbox in Blender {bpy.app.version_string}").write()
    if not any(each.category == "light" for each in parent.statements):
        raise RecipeError(f"the scene {scene.name} has no light, add a lamp or let a mesh or the world shine")
    table, files = _table(scene, name, parent), SpectrumFiles()
    mappings = mappings_text(parent.statements, table, files, blend_folder())
    return SceneRecipe(
        name,
        _options(scene, parent),
        MontageOptions(scene.rtb.montage_columns or None, scene.rtb.montage_fill),
        parent.content,
        table.conditions(name),
        mappings,
        files.contents,
        _provenance(),
        tuple(dict.fromkeys(seen.remarks)),
        _folder(scene),
    )


def _options(scene, parent: Parent) -> RecipeOptions:
    settings = scene.rtb
    return RecipeOptions(
        renderer=settings.renderer,
        width=settings.width,
        height=settings.height,
        bands=(shortest(settings.bands_start), shortest(settings.bands_step), settings.bands_count),
        samples=settings.samples,
        seed=settings.seed,
        integrator=settings.integrator,
        depth=settings.depth,
        camera=_camera(scene.camera.name_full, parent, "the scene's camera"),
    )


def _table(scene, name: str, parent: Parent) -> Table:
    """Return the scene's conditions; a camera among the cells is named by its id."""
    settings = scene.rtb
    variables = [each.name for each in settings.variables]
    if twins := [each for each, count in Counter(variables).items() if count > 1 or not each.strip()]:
        raise RecipeError(f"the variable '{twins[0]}' needs a name that no other one has")
    names, rows = [], []
    for number, condition in enumerate(settings.conditions, 1):
        names.append(condition.name.strip() or f"{name}-{number:03}")
        cells = [each.value for each in condition.cells]
        if len(cells) != len(variables):
            raise RecipeError(
                f"the condition {names[-1]} has {len(cells)} cells for {len(variables)} variables"
            )
        row = dict(zip(variables, cells, strict=True))
        if _CAMERA in row:
            row[_CAMERA] = _camera(row[_CAMERA], parent, f"the camera of the condition {names[-1]}")
        rows.append(row)
    return Table(variables, names, rows)


def _camera(name: str, parent: Parent, what: str) -> str:
    if name not in parent.cameras:
        known = ", ".join(parent.cameras) or "none"
        raise RecipeError(f"{what} is {name}, which does not render; cameras that do: {known}")
    return parent.cameras[name]


def _provenance() -> dict[str, str]:
    """Return who made this with what; no paths, no times."""
    blend = Path(bpy.data.filepath).name
    return {"blender": bpy.app.version_string, **({"blend": blend} if blend else {})}


def _folder(scene) -> Path | None:
    try:
        return recipe_folder(scene)
    except RecipeError:
        return None
