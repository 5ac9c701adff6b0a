"""A Blender scene as a recipe: the last look at Blender before files and processes take over."""

from __future__ import annotations

import json
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import NamedTuple

import bpy

from ..errors import RecipeError
from ..layers import NAMES as LAYERS
from ..recipe import Conventions, MontageOptions, RecipeOptions
from ..recipe.options import section
from ..scene.collada.write_numbers import shortest
from ..scene.differences import Told, told_apart
from ..spectra import Spectrum, Unit
from ..spectra.spoken import spectrum_from
from .baked import PARENT_COLUMNS, Remodel, merged, parent_files
from .folders import blend_folder, own_folder, recipe_name
from .migration import refuse_newer
from .own_spectra import own_folders
from .parent import Parent
from .path_mappings import paths_text
from .preview import suspended
from .renderer_choices import renderer_of
from .scene_looks import Look, look_of, looks_in_steps, remodeled_looks
from .scene_recipe import SceneRecipe
from .seen import seen_in
from .spectrum_files import SpectrumFiles
from .statement_mappings import Hear, mappings_text
from .table import Table, table_of
from .written_mappings import declared_in, resources_of, written_mappings

_CAMERA = "camera"
Finish = Callable[[], SceneRecipe]


def read_recipe(scene: bpy.types.Scene, remodel: Remodel | None = None) -> SceneRecipe:
    """
    Return the recipe of a scene as it renders at its current frame.

    Parameters
    ----------
    remodel : edits the scene for one condition, ``remodel(scene, condition)``; each condition then has its
        own parent scene, and the scene is as before afterwards
    """
    if remodel is not None:
        refuse_newer(scene)
        with suspended():
            table = table_of(scene, recipe_name(scene))
            return _finishing(scene, table, remodeled_looks(scene, table, remodel), _all_apart)()
    steps = read_in_steps(scene)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value()


def read_in_steps(scene: bpy.types.Scene) -> Generator[float, None, Finish]:
    """
    Look at a scene one condition after the other, and return what makes a recipe of that.

    Yields how much is done, 0 to 1; the scene is as before whenever it does, and must stay so. What is
    returned needs Blender no more: any thread may call it.
    """
    refuse_newer(scene)
    with suspended():
        table = table_of(scene, recipe_name(scene))
        looks = yield from looks_in_steps(scene, table)
        return _finishing(scene, table, looks, told_apart)


def read_rendered(scene: bpy.types.Scene, depsgraph) -> SceneRecipe:
    """
    Return the recipe of a scene's active condition alone.

    Parameters
    ----------
    depsgraph : the scene as a render engine is shown it, with its properties as the condition sets them
    """
    refuse_newer(scene)
    table = table_of(scene, recipe_name(scene))
    row = min(scene.rtb.active_condition, max(len(table.names) - 1, 0))
    return _finishing(scene, table.only(row), [look_of(scene, seen_in(depsgraph))], told_apart)()


def _finishing(scene, table: Table, looks: list[Look], tell_apart: Callable[[list[bytes]], Told]) -> Finish:
    """Take in what else the scene says, and return what makes a recipe of it all."""
    settings, folder, own = scene.rtb, blend_folder(), own_folders()
    make = partial(
        SceneRecipe,
        name=recipe_name(scene),
        options=_options(scene, _name_cameras(table, looks)),
        conventions=Conventions(settings.units, settings.handedness),
        montage=MontageOptions(settings.montage_columns or None, settings.montage_fill),
        provenance=_provenance(),
        report=tuple(dict.fromkeys(remark for each in looks for remark in each.remarks)),
        folder=_folder(scene),
    )
    written = Written(written_mappings(scene), declared_in(scene), resources_of(scene))

    def finish() -> SceneRecipe:
        told = tell_apart([each.parent.content for each in looks])
        return _finished(make, table, looks, told, written, partial(_heard, folder=folder, own=own))

    return finish


class Written(NamedTuple):
    """
    What somebody has written, and not said in Blender.

    Parameters
    ----------
    mappings : their text
    declared : ids of the materials and lights that it declares
    resources : the files that it may name
    """

    mappings: str
    declared: set[str]
    resources: Mapping[str, bytes]


def _finished(
    make: partial[SceneRecipe],
    table: Table,
    looks: Sequence[Look],
    told: Told,
    written: Written,
    hear: Hear,
) -> SceneRecipe:
    """Return a recipe with the parent scenes and the mappings that looks at its scene come to."""
    base, files = make.keywords["name"], SpectrumFiles()
    names = table.names if len(looks) > 1 else [base]
    cells, further = parent_files(names, told.contents)
    if further:
        table.varied(PARENT_COLUMNS[0], cells)
    statements = merged(names, [each.parent.statements for each in looks])
    wanted = [each for each in statements if each.id not in written.declared]
    mappings = mappings_text(wanted, table, files, hear) + paths_text(told.values, table)
    return make(
        parent=told.contents[0],
        conditions=table.conditions(base),
        mappings=mappings + written.mappings,
        generated=mappings.count("\n"),
        resources={**written.resources, **files.contents, **further},
    )


def _heard(text: str, unit: Unit, folder: Path | None, own: Sequence[Path]) -> Spectrum:
    return spectrum_from(text, unit, folder, own)


def _all_apart(contents: list[bytes]) -> Told:
    """Leave documents as they are, each in a file of its own."""
    return Told(contents, {})


def _options(scene, camera: str) -> RecipeOptions:
    """Return the options that the scene says, and those that it has kept of a recipe that was opened."""
    settings = scene.rtb
    kept = section(RecipeOptions, json.loads(settings.further)) if settings.further else RecipeOptions()
    return replace(
        kept,
        renderer=renderer_of(settings, f"the scene {scene.name}"),
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


def _name_cameras(table: Table, looks: Sequence[Look]) -> str:
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


def _folder(scene) -> Path | RecipeError:
    try:
        return own_folder(scene)
    except RecipeError as error:  # said by whoever wants to save it there
        return error
