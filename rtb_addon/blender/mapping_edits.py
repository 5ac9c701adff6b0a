"""Edits of the mappings of a scene: which properties conditions set, and to what."""

from __future__ import annotations

import bpy

from ..errors import RecipeError, choices
from .place_values import shown
from .place_words import subject
from .places import Place, found_at, refuse_fixed, value_at
from .table_edits import add_row, add_variable, free_name

# Datablocks whose properties conditions may set; what shows them in an interface is none of them.
HOMES = (
    *("objects", "lights", "cameras", "materials", "worlds", "meshes", "curves", "metaballs", "shape_keys"),
    *("node_groups", "collections", "lattices", "armatures", "textures", "images", "scenes"),
)


def named(home: str, name: str):
    """Return a datablock by the list that holds it and its name."""
    if home not in HOMES:
        raise RecipeError(f"nothing in {home} can vary, it must be one of {', '.join(HOMES)}")
    if (found := getattr(bpy.data, home).get(name)) is None:
        raise RecipeError(
            f"nothing is called {name}, there are {choices(name, getattr(bpy.data, home).keys())}"
        )
    return found


def home_of(thing) -> str | None:
    """Return the list of bpy.data that holds a datablock, None for one that cannot vary."""
    for home in HOMES:
        if thing.name in getattr(bpy.data, home) and getattr(bpy.data, home)[thing.name] == thing:
            return home
    return None


def owner_and_path(struct, name: str) -> tuple[object, str] | None:
    """Return the datablock that holds a property of a struct, and the path to it from there."""
    thing = struct.id_data
    if thing is None:
        return None
    try:
        path = name if struct == thing else struct.path_from_id(name)
    except ValueError:
        return None
    if getattr(thing, "is_embedded_data", False):  # the nodes of a material, a world or a lamp
        owners = (each for home in ("materials", "worlds", "lights") for each in getattr(bpy.data, home))
        thing = next((each for each in owners if each.node_tree == thing), None)
        path = f"node_tree.{path}"
    return None if thing is None or home_of(thing) is None else (thing, path)


def varying(struct, kind) -> tuple[object, str] | None:
    """Return the datablock and the path of a property that conditions could set, None for any other."""
    if isinstance(struct, bpy.types.PropertyGroup) and isinstance(struct.id_data, bpy.types.Scene):
        return None  # the recipe itself
    found = owner_and_path(struct, kind.identifier)
    if found is None:
        return None
    try:
        refuse_fixed(found_at(*found, -1, ""), *found, "")
    except RecipeError:
        return None
    return found


def vary(settings, thing, path: str, index: int, variable: str = "") -> str:
    """Let conditions say a property, as it is now at first; return the name of the variable."""
    called = subject(thing, path, index)
    place = found_at(thing, path, index, called)
    refuse_fixed(place, thing, path, called)
    refuse_twice(settings, thing, path, index, called)
    now = shown(place)
    name = variable or free_name(_variable(thing, place), [each.name for each in settings.variables])
    add_variable(settings, name, now, _kind(place))
    if not settings.conditions:
        add_row(settings, "", [now])
    add_mapping(settings, thing, path, index, f"({name})")
    return name


def add_mapping(settings, thing, path: str, index: int, value: str) -> None:
    """Let conditions set a property to what a text comes to."""
    mapping = settings.mappings.add()
    mapping.name = subject(thing, path, index)
    mapping.thing, mapping.path, mapping.index, mapping.value = thing, path, index, value
    settings.active_mapping = len(settings.mappings) - 1


def refuse_twice(settings, thing, path: str, index: int, called: str, but: int = -1) -> None:
    """Raise where another mapping sets a property already."""
    for number, each in enumerate(settings.mappings):
        same = (
            each.thing == thing and each.path == path and (each.index == index or -1 in (each.index, index))
        )
        if same and number != but:
            raise RecipeError(f"{called} varies already, it is {each.value}")


def _variable(thing, place: Place) -> str:
    """Return what a property's variable is called: lamp_location_z."""
    name = place.name
    if place.index >= 0:
        name = f"{name}_{'xyzw'[place.index] if place.index < 4 else place.index + 1}"
    return "".join(each if each.isalnum() else "_" for each in f"{thing.name}_{name}".lower())


def _kind(place: Place) -> str:
    """Return the type of variable that fits a property."""
    value = value_at(place)
    if place.kind is not None and place.kind.type == "POINTER":
        return "OBJECT" if place.kind.fixed_type.identifier == "Object" else "TEXT"
    if isinstance(value, list):
        return (
            "COLOUR" if len(value) == 3 and place.kind and place.kind.subtype.startswith("COLOR") else "TEXT"
        )
    return "TEXT" if isinstance(value, (str, bool)) else "NUMBER"
