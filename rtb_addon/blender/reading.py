"""A Blender scene as a recipe: the last look at Blender before files and processes take over."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy

from ..conditions import Condition, Conditions
from ..errors import RecipeError
from ..layers import NAMES as LAYERS
from ..recipe import Conventions, MontageOptions, RecipeOptions, write_recipe
from ..recipe.options import section
from ..scene.collada.write_numbers import shortest
from ..scene.differences import Told, told_apart
from .baked import PARENT_COLUMNS, Remodel, at_condition, baked, merged, parent_files
from .conditions import IMAGE_NAME
from .evaluation import as_rendered
from .folders import blend_folder, recipe_folder, recipe_name
from .mapped import set_for, values_for
from .migration import refuse_newer
from .parent import Parent, ParentWriter
from .path_mappings import paths_text
from .preview import suspended
from .seen import Seen, seen_in
from .table import SpectrumFiles, Table, mappings_text
from .table_properties import spoken_cell
from .varied import set_value, subject_of, value_at
from .written_mappings import declared_in, resources_of, written_mappings

_CAMERA = "camera"


@dataclass(frozen=True)
class SceneRecipe:
    """
    A recipe that a scene holds, ready to be written.

    Parameters
    ----------
    parent : the parent scene, Collada 1.4.1
    mappings : text of the mappings file
    generated : how many of its lines are made from what the scene says elsewhere, the first ones
    resources : contents of files by their names below resources/
    report : what had to be assumed or is left out, a sentence each
    folder : where it is saved unless said otherwise; None while an unsaved .blend file leaves that open
    """

    name: str
    options: RecipeOptions
    conventions: Conventions
    montage: MontageOptions
    parent: bytes
    conditions: Conditions
    mappings: str
    generated: int
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
            self.conventions,
            self.montage,
            self.parent,
            self.conditions,
            self.mappings,
            self.resources,
            self.provenance,
        )
        return chosen


@dataclass(frozen=True)
class _Look:
    """A scene at one time: its parent scene, the name of its camera, and remarks."""

    parent: Parent
    camera: str
    remarks: tuple[str, ...]


def read_recipe(scene: bpy.types.Scene, remodel: Remodel | None = None) -> SceneRecipe:
    """
    Return the recipe of a scene as it renders at its current frame.

    Parameters
    ----------
    remodel : edits the scene for one condition, ``remodel(scene, condition)``; each condition then has its
        own parent scene, and the scene is as before afterwards
    """
    refuse_newer(scene)
    with suspended():
        return _read(scene, remodel)


def read_rendered(scene: bpy.types.Scene, depsgraph) -> SceneRecipe:
    """
    Return the recipe of a scene's active condition alone.

    Parameters
    ----------
    depsgraph : the scene as a render engine is shown it, with its properties as the condition sets them
    """
    refuse_newer(scene)
    table = _table(scene, recipe_name(scene))
    if table.names:
        row = min(scene.rtb.active_condition, len(table.names) - 1)
        table = Table(table.variables, [table.names[row]], [table.cells[row]])
    return _recipe(scene, table, [_looked(scene, seen_in(depsgraph))], told_apart)


def _read(scene, remodel: Remodel | None) -> SceneRecipe:
    table = _table(scene, recipe_name(scene))
    tell_apart = told_apart if remodel is None else lambda contents: Told(contents, {})
    return _recipe(scene, table, _looks(scene, table, remodel), tell_apart)


def _recipe(
    scene, table: Table, looks: list[_Look], tell_apart: Callable[[list[bytes]], Told]
) -> SceneRecipe:
    name, files = recipe_name(scene), SpectrumFiles()
    camera = _name_cameras(table, looks)
    parents = [each.parent for each in looks]
    names = table.names if len(looks) > 1 else [name]
    told = tell_apart([each.content for each in parents])
    cells, further = parent_files(names, told.contents)
    if further:
        table.varied(PARENT_COLUMNS[0], cells)
    declared = declared_in(scene)
    statements = [
        each for each in merged(names, [one.statements for one in parents]) if each.id not in declared
    ]
    mappings = mappings_text(statements, table, files, blend_folder()) + paths_text(told.values, table)
    generated = mappings.count("\n")
    return SceneRecipe(
        name,
        _options(scene, camera),
        Conventions(scene.rtb.units, scene.rtb.handedness),
        MontageOptions(scene.rtb.montage_columns or None, scene.rtb.montage_fill),
        told.contents[0],
        table.conditions(name),
        mappings + written_mappings(scene),
        generated,
        {**resources_of(scene), **files.contents, **further},
        _provenance(),
        tuple(dict.fromkeys(remark for each in looks for remark in each.remarks)),
        _folder(scene),
    )


def _looks(scene, table: Table, remodel: Remodel | None) -> list[_Look]:
    """Return the scene once, or as the properties that conditions set and a function make it for each."""
    mapped = scene.rtb.mappings
    if remodel is not None:

        def both(scene, condition) -> None:
            for place, value in values_for(scene.rtb, condition.cells):
                set_value(place, value)
            remodel(scene, condition)

        return _baked(scene, table, both if mapped else remodel)
    if not mapped:
        return [_look(scene)]
    if not table.names:
        raise RecipeError(f"{subject_of(mapped[0])} varies, but there are no conditions: add one")
    looks: dict[str, _Look] = {}
    found = []
    for name, cells in zip(table.names, table.typed, strict=True):
        with at_condition(name), set_for(scene.rtb, cells):
            values = repr([value_at(place) for place, _ in values_for(scene.rtb, cells)])
            found.append(looks[values] if values in looks else looks.setdefault(values, _look(scene)))
    return found


def _look(scene) -> _Look:
    """Return the scene as it is now."""
    if scene.camera is None:
        raise RecipeError(f"the scene {scene.name} has no camera, add one")
    return _looked(scene, as_rendered(scene, seen_in))


def _looked(scene, seen: Seen) -> _Look:
    """Return a scene as an engine has been shown it."""
    parent = ParentWriter(seen, scene.name, f"RenderToolbox in Blender {bpy.app.version_string}").write()
    if not any(each.category == "light" for each in parent.statements):
        raise RecipeError(f"the scene {scene.name} has no light, add a lamp or let a mesh or the world shine")
    return _Look(parent, scene.camera.name_full, tuple(seen.remarks))


def _baked(scene, table: Table, remodel: Remodel) -> list[_Look]:
    """Return the scene as a function remodels it for each condition."""
    if not table.names:
        raise RecipeError("there are no conditions to remodel the scene for, add one")
    if own := [each for each in PARENT_COLUMNS if each in table.variables]:
        raise RecipeError(f"the column {own[0]} is written from what the function does, take it out")
    rows = zip(table.names, table.typed, strict=True)
    conditions = [Condition(name, {IMAGE_NAME: name, **cells}, 0) for name, cells in rows]
    known: dict[bytes, bytes] = {}  # parents that are the same take their room in memory once

    def look() -> _Look:
        found = _look(scene)
        found.parent.content = known.setdefault(found.parent.content, found.parent.content)
        return found

    return baked(scene, conditions, remodel, look)


def _options(scene, camera: str) -> RecipeOptions:
    """Return the options that the scene says, and those that it has kept of a recipe that was opened."""
    settings = scene.rtb
    kept = section(RecipeOptions, json.loads(settings.further)) if settings.further else RecipeOptions()
    return replace(
        kept,
        renderer=settings.renderer,
        width=settings.width,
        height=settings.height,
        bands=(shortest(settings.bands_start), shortest(settings.bands_step), settings.bands_count),
        samples=settings.samples,
        until_error=shortest(settings.until_error) or None,
        seed=settings.seed,
        filter=settings.filter,
        band_kind=settings.band_kind,
        layers=tuple(name for name in LAYERS if name in settings.layers or name in kept.layers),
        integrator=settings.integrator,
        depth=settings.depth,
        camera=camera,
    )


def _table(scene, name: str) -> Table:
    """Return the scene's conditions."""
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
        rows.append(dict(zip(variables, cells, strict=True)))
    kinds = {each.name: each for each in settings.variables}
    spoken = [{name: spoken_cell(kinds[name], cell) for name, cell in row.items()} for row in rows]
    return Table(variables, names, rows, spoken)


def _name_cameras(table: Table, looks: Sequence[_Look]) -> str:
    """Return the id of the scene's camera; cameras among the cells, or that vary, become ids as well."""
    ids = [_camera(each.camera, each.parent, "the scene's camera") for each in looks]
    if _CAMERA in table.variables:
        for row, name in enumerate(table.names):
            parent = looks[row if len(looks) > 1 else 0].parent
            cell = _camera(table.cells[row][_CAMERA], parent, f"the camera of the condition {name}")
            table.cells[row][_CAMERA] = cell
    elif len(set(ids)) > 1:
        table.varied(_CAMERA, ids)
    return ids[0]


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
