"""Properties of Blender that conditions set: found by their paths, read, written and given back exactly."""

from __future__ import annotations

from contextlib import suppress
from typing import Any, NamedTuple

import bpy

from ..errors import RecipeError
from .kept_values import UNSET

# Of scenes only what decides how they look, and what no other column says.
_OF_SCENES = ("frame_current", "camera", "world")


class Place(NamedTuple):
    """
    Where a property is.

    Parameters
    ----------
    owner : the struct that has it
    name : of the property
    index : of a component, -1 for the whole property
    kind : the property as Blender describes it; None for a custom property
    """

    owner: Any
    name: str
    index: int
    kind: Any


def subject_of(mapping) -> str:
    """Return what a mapping sets, as the beginning of a sentence: Location Z of the object Lamp."""
    return mapping.name or mapping.path


def place_of(mapping) -> Place:
    """Return where the property of a mapping is, or raise what is missing."""
    lost = isinstance(mapping.thing, bpy.types.Object) and not mapping.thing.users_scene
    if mapping.thing is None or lost:
        raise RecipeError(f"{subject_of(mapping)}: what it belongs to is gone, choose another or remove this")
    return found_at(mapping.thing, mapping.path, mapping.index, subject_of(mapping))


def found_at(thing, path: str, index: int, subject: str) -> Place:
    """Return where a property is, by its path from a datablock."""
    way, _, name = path.rpartition(".")
    if path.endswith("]"):  # a custom property: modifiers["Shift"]["Socket_1"]
        way, _, key = path.rpartition("[")
        name = key[1:-2]
    try:
        owner = thing.path_resolve(way) if way else thing
        kind = None if path.endswith("]") else owner.bl_rna.properties[name]
        if kind is None:
            owner[name]
    except (ValueError, KeyError, AttributeError, TypeError) as error:
        raise RecipeError(f"{subject}: {thing.name} has no {path}") from error
    length = getattr(kind, "array_length", 0) if kind is not None else _length(owner[name])
    if index >= max(length, 0) and index >= 0:
        raise RecipeError(f"{subject}: it has {length} components, none is number {index + 1}")
    return Place(owner, name, index, kind)


def refuse_fixed(place: Place, thing, path: str, subject: str) -> None:
    """Raise why a property cannot be set by conditions, if it cannot."""
    if isinstance(thing, bpy.types.Scene) and path not in _OF_SCENES:
        known = ", ".join(_OF_SCENES)
        raise RecipeError(f"{subject}: of a scene only {known} can vary, other settings are the recipe's")
    if thing.library is not None:
        raise RecipeError(f"{subject}: {thing.name} is linked from another file, make it local to vary it")
    if place.kind is not None:
        unwritable = place.kind.is_readonly or place.kind.type == "COLLECTION"
        if unwritable or getattr(place.kind, "is_enum_flag", False):
            raise RecipeError(f"{subject}: Blender lets nobody set it")
    if any(_drives(each, path, place.index) for each in _curves(thing)):
        raise RecipeError(f"{subject}: it is animated or driven, which would overrule the conditions")


def kept_value(place: Place):
    """Return what a property is, or UNSET for one of an extension that nobody has set."""
    own = place.kind is not None and isinstance(place.owner, bpy.types.PropertyGroup)
    return UNSET if own and not place.owner.is_property_set(place.name) else value_at(place)


def give_back(place: Place, value) -> None:
    """Let a property be what it was."""
    if value == UNSET and place.kind is not None and isinstance(place.owner, bpy.types.PropertyGroup):
        place.owner.property_unset(place.name)
    else:
        set_value(place, value)


def changed_along(place: Place) -> list[tuple[Any, str, int, Place]]:
    """Return what else changes with a property: where it is the frame, all that is animated."""
    if not isinstance(place.owner, bpy.types.Scene) or place.name != "frame_current":
        return []
    found = []
    for home in {each.identifier: each for each in bpy.data.bl_rna.properties if each.type == "COLLECTION"}:
        for thing in getattr(bpy.data, home):
            for curve in _curves(thing) if hasattr(thing, "animation_data") else ():
                with suppress(RecipeError):
                    index = curve.array_index
                    whole = found_at(thing, curve.data_path, -1, "")
                    index = index if isinstance(value_at(whole), list) else -1
                    found.append((thing, curve.data_path, index, whole._replace(index=index)))
    return found


def value_at(place: Place):
    """Return what a property is, as plain values that are the same to the bit."""
    value = place.owner[place.name] if place.kind is None else getattr(place.owner, place.name)
    if hasattr(value, "to_list"):
        value = value.to_list()
    elif not isinstance(value, (str, bytes, bpy.types.ID)) and hasattr(value, "__len__"):
        value = list(value)
    return value[place.index] if place.index >= 0 else value


def set_value(place: Place, value) -> None:
    """Set a property."""
    if isinstance(place.owner, bpy.types.Scene) and place.name == "frame_current":
        place.owner.frame_set(value)
    elif place.kind is None and place.index < 0:
        place.owner[place.name] = value
        place.owner.id_data.update_tag()
    elif place.index >= 0:
        vector = place.owner[place.name] if place.kind is None else getattr(place.owner, place.name)
        vector[place.index] = value
        place.owner.id_data.update_tag()
    else:
        setattr(place.owner, place.name, value)


def _length(value) -> int:
    return len(value) if not isinstance(value, (str, bytes)) and hasattr(value, "__len__") else 0


def _curves(thing):
    """Return the animation curves and drivers of a datablock."""
    data = getattr(thing, "animation_data", None)
    if data is None:
        return []
    curves = list(data.drivers)
    action = data.action
    if action is None:
        return curves
    if hasattr(action, "fcurves"):
        return [*curves, *action.fcurves]
    return curves + [
        curve
        for layer in action.layers
        for strip in layer.strips
        if (bag := strip.channelbag(data.action_slot)) is not None
        for curve in bag.fcurves
    ]


def _drives(curve, path: str, index: int) -> bool:
    return curve.data_path == path and (index < 0 or curve.array_index in (index, 0))
