"""Everything that keeps a scene from becoming a recipe, found without stopping at the first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import bpy

from ..errors import RecipeError
from .conditions import VARIABLE
from .folders import blend_folder, recipe_name, typed
from .mapped import cells_by_name, value_for
from .place_words import thing_word
from .table_edits import spoken_fields
from .written_mappings import written_mappings


def scene_problems(scene) -> list[str]:
    """Return a sentence for each problem of a scene, each once."""
    return list(
        dict.fromkeys((*_of_objects(scene), *_of_names(scene), *_of_spectra(scene), *_of_mappings(scene)))
    )


def _of_objects(scene) -> Iterator[str]:
    if scene.camera is None:
        yield f"the scene {scene.name} has no camera, add one"
    for object_ in scene.objects:
        seen = object_.type == "MESH" and not object_.hide_render and len(object_.data.polygons)
        if seen and not any(slot.material for slot in object_.material_slots):
            yield f"the object {object_.name_full} has no material, give it one"


def _of_names(scene) -> Iterator[str]:
    settings, recipe = scene.rtb, recipe_name(scene)
    for name, count in Counter(each.name for each in settings.variables).items():
        if count > 1 or not name.strip():
            yield f"the variable '{name}' needs a name that no other one has"
    rows = [row.name.strip() or f"{recipe}-{number:03}" for number, row in enumerate(settings.conditions, 1)]
    for name, count in Counter(name.casefold() for name in rows).items():
        if count > 1:
            shown = next(each for each in rows if each.casefold() == name)
            yield f"the condition {shown} is not the only one of that name, each needs its own"


def _of_spectra(scene) -> Iterator[str]:
    """Find fault with each spectrum, in each condition that says something for it."""
    for group, field in spoken_fields():
        thing = group.id_data
        if thing.users and _counts(scene, thing) and (text := getattr(group, field).strip()):
            owner = f"the {thing_word(thing)} {thing.name_full}"
            yield from _of_spectrum(scene, owner, typed(text, thing))


def _counts(scene, thing) -> bool:
    """Return whether a thing speaks in spectra, and is in the scene."""
    if isinstance(thing, bpy.types.World):
        return thing.rtb.use_spectra and scene.world == thing
    if isinstance(thing, bpy.types.Object):
        return thing.rtb.emits and scene.objects.get(thing.name) == thing
    if not thing.rtb.use_spectra:
        return False
    return any(each.data == thing or thing in _materials(each) for each in scene.objects)


def _materials(object_) -> list:
    return [slot.material for slot in object_.material_slots]


def _of_spectrum(scene, owner: str, text: str) -> Iterator[str]:
    settings, used = scene.rtb, VARIABLE.findall(text)
    known = [each.name for each in settings.variables]
    if unknown := [name for name in used if name not in known]:
        yield f"{owner} uses ({unknown[0]}), the variables of the conditions are {', '.join(known) or 'none'}"
        return
    if used and not len(settings.conditions):
        yield f"{owner} uses ({used[0]}), but there are no conditions"
    if not used:
        yield from _unreadable(owner, text)
    for number, row in enumerate(settings.conditions if used else (), 1):
        cells, name = cells_by_name(settings, row), row.name.strip() or f"{recipe_name(scene)}-{number:03}"
        if empty := [each for each in used if not cells[each].strip()]:
            yield f"the condition {name} says nothing for {empty[0]}, {owner} needs it"
        else:
            said = VARIABLE.sub(lambda found, cells=cells: cells[found[1]], text)
            yield from (f"the condition {name}: {each}" for each in _unreadable(owner, said))


def _unreadable(owner: str, text: str) -> Iterator[str]:
    # numpy takes longer to come than enabling may last.
    from ..spectra import Unit
    from ..spectra.spoken import spectrum_from

    try:
        spectrum_from(text, Unit.SHAPE, blend_folder())
    except (RecipeError, OSError) as error:
        yield f"{owner}: {error}"


def _of_mappings(scene) -> Iterator[str]:
    settings = scene.rtb
    for mapping in settings.mappings:
        for row in settings.conditions:
            try:
                value_for(mapping, cells_by_name(settings, row))
            except RecipeError as error:
                yield str(error)
    try:
        written_mappings(scene)
    except RecipeError as error:
        yield str(error)
