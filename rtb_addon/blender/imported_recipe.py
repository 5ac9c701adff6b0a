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
from .imported_parts import Part, parts_of
from .imported_scene import Importer

# Options that the scene has properties for; others are kept as they are.
_SAME = ("width", "height", "samples", "seed", "integrator", "depth", "filter", "band_kind")
_OWN = (*_SAME, "renderer", "bands", "until_error", "layers", "camera")


def open_recipe(folder: Path | str) -> tuple[list[bpy.types.Scene], list[str]]:
    """
    Put a recipe into new scenes of the open file, and return them with what is left out.

    What it renders stays the same: mappings come along as they are written, spectra stay where they lie. A
    scene of Blender has one parent scene and one list of mappings; rows that have others go into scenes of
    their own.
    """
    recipe = Recipe.load(folder)
    scenes: list[bpy.types.Scene] = []
    remarks: list[str] = []
    try:
        for part in parts_of(recipe):
            scenes.append(bpy.data.scenes.new(part.name))
            remarks += _fill(scenes[-1], recipe, part)
    except BaseException:
        for scene in scenes:
            _remove(scene)
        raise
    if len(scenes) > 1:
        names = ", ".join(each.name for each in scenes)
        remarks.append(
            f"its rows have {len(scenes)} parent scenes or mappings, each is a scene here: {names}"
        )
    return scenes, list(dict.fromkeys(remarks))


def _fill(scene, recipe: Recipe, part: Part) -> list[str]:
    """Put a part of a recipe into a scene, and return what is left out."""
    size = recipe.options.width, recipe.options.height
    importer = Importer(part.document, scene, size, part.placed)
    importer.put()
    settings = scene.rtb
    settings.name = part.name
    if (resources := recipe.folder / "resources").is_dir():
        settings.resources = str(resources)
    settings.units, settings.handedness = recipe.conventions.units, recipe.conventions.handedness
    remarks = [*importer.remarks, *_set_options(scene, recipe)]
    _set_table(scene, part, importer.renamed)
    _set_camera(scene, importer, recipe.options.camera)
    return remarks


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


def _set_table(scene, part: Part, renamed: Mapping[str, str]) -> None:
    """Fill in the table and the mappings; a single condition without table stays one."""
    if part.columns or part.rows[0].cells:
        rows = zip((row.name for row in part.rows), *part.columns.values(), strict=True)
        set_conditions(scene, [IMAGE_NAME, *part.columns], rows)
    if part.mappings.strip():
        scene.rtb.mappings_text = bpy.data.texts.new(f"{part.name} mappings")
        scene.rtb.mappings_text.write(_with_ids(part.mappings, renamed))


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
