"""A recipe's folder opened in Blender: scene, table, mappings and options."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path

import bpy

from ..errors import RecipeError
from ..recipe import Recipe
from ..recipe.options import section_words
from .conditions import IMAGE_NAME, set_conditions
from .imported_scene import Importer
from .json_mappings import as_blocks

# Options that the scene has properties for; others are kept as they are.
_SAME = ("width", "height", "samples", "seed", "integrator", "depth", "filter", "band_kind")
_OWN = (*_SAME, "renderer", "bands", "until_error", "layers", "camera")


def open_recipe(folder: Path | str) -> tuple[bpy.types.Scene, list[str]]:
    """
    Put a recipe into a new scene of the open file, and return that with what is left out.

    What it renders stays the same: mappings come along as they are written, spectra stay where they lie.
    """
    recipe = Recipe.load(folder)
    conditions, options = recipe.conditions, recipe.options
    parents = dict.fromkeys(row.parent_scene for row in conditions)
    document = recipe.parent_of(conditions.rows[0])
    scene = bpy.data.scenes.new(recipe.name)
    importer = Importer(document, scene, (options.width, options.height))
    try:
        importer.put()
    except BaseException:
        _remove(scene)
        raise
    settings = scene.rtb
    settings.name = recipe.name
    if (resources := recipe.folder / "resources").is_dir():
        settings.resources = str(resources)
    settings.units, settings.handedness = recipe.conventions.units, recipe.conventions.handedness
    remarks = [*importer.remarks, *_set_options(scene, recipe)]
    remarks += _set_table(scene, recipe, importer.renamed)
    _set_camera(scene, importer, options.camera)
    if len(parents) > 1:
        remarks.append(f"conditions have {len(parents)} parent scenes, that of the first one was opened")
    return scene, remarks


def _set_options(scene, recipe: Recipe) -> list[str]:
    options, settings = recipe.options, scene.rtb
    for name in _SAME:
        setattr(settings, name, getattr(options, name))
    settings.until_error = options.until_error or 0.0
    settings.layers = set(options.layers)
    settings.bands_start, settings.bands_step, settings.bands_count = options.bands
    settings.montage_columns, settings.montage_fill = recipe.montage.columns or 0, recipe.montage.fill
    words = section_words(options)
    own = _OWN if not options.centres else tuple(name for name in _OWN if name != "bands")
    further = {name: value for name, value in words.items() if name not in own}
    settings.further = json.dumps(further)
    try:
        settings.renderer = options.renderer
    except TypeError:
        return [f"the renderer {options.renderer} is none that Blender offers, {settings.renderer} is chosen"]
    return []


def _set_table(scene, recipe: Recipe, renamed: Mapping[str, str]) -> list[str]:
    """Fill in the table and the mappings; a single condition without table stays one."""
    rows, remarks = recipe.conditions, []
    lost = [name for name in ("colladaFile", "parentScene", "mappingsFile") if name in rows.variables]
    if lost:
        remarks.append(f"the columns {', '.join(lost)} are left out, a scene of Blender has one parent scene")
    variables = [each for each in dict.fromkeys(rows.variables) if each not in (IMAGE_NAME, *lost)]
    cells = [[row.cells[name] for name in variables] for row in rows]
    text, added = recipe.mappings.text, {}
    if recipe.mappings.is_json:
        text, added = as_blocks(recipe)
    names = [row.name for row in rows]
    table = [
        [name, *row, *(values[number] for values in added.values())]
        for number, (name, row) in enumerate(zip(names, cells, strict=True))
    ]
    if rows.variables or added:
        set_conditions(scene, [IMAGE_NAME, *variables, *added], table)
    if text.strip():
        scene.rtb.mappings_text = bpy.data.texts.new(f"{recipe.name} mappings")
        scene.rtb.mappings_text.write(_with_ids(text, renamed))
    return remarks


def _with_ids(text: str, renamed: Mapping[str, str]) -> str:
    """Return mappings with ids that things have got because their names were taken."""
    if not renamed:
        return text
    words = re.compile(rf"(?<![\w-])({'|'.join(map(re.escape, renamed))})(?![\w-])(?=[.:$])")
    return words.sub(lambda found: renamed[found[1]], text)


def _set_camera(scene, importer: Importer, wanted: str) -> None:
    """Choose the recipe's camera; rows that name one name its object."""
    cameras = importer.cameras
    if not cameras:
        raise RecipeError("the parent scene has no camera")
    scene.camera = cameras.get(wanted) or next(iter(cameras.values()))
    number = scene.rtb.variables.find("camera")
    for row in scene.rtb.conditions if number >= 0 else ():
        if row.cells[number].value in cameras:
            row.cells[number].value = cameras[row.cells[number].value].name


def _remove(scene) -> None:
    for each in list(scene.collection.objects):
        bpy.data.objects.remove(each)
    bpy.data.scenes.remove(scene)
