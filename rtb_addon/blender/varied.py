"""Properties of Blender that conditions set: found by their paths, read and written exactly."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from contextlib import suppress
from typing import Any, NamedTuple

import bpy

from ..errors import RecipeError, choices
from .kept_values import UNSET
from .table_properties import in_digits, numbers_of

VARIABLE = re.compile(r"\(([^()]+)\)")
_NUMBERS = ("FLOAT", "INT", "BOOLEAN")
_AXES = {"COLOR": "RGBA", "COLOR_GAMMA": "RGBA", "QUATERNION": "WXYZ", "AXISANGLE": "WXYZ"}
_WORDS = {"true": 1, "yes": 1, "on": 1, "false": 0, "no": 0, "off": 0}
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


def meant(place: Place, text: str, cells: Mapping[str, str]):
    """Return the value that a mapping's text comes to in a condition; angles are said in degrees."""
    kind = _type(place)
    if kind not in _NUMBERS:
        return _chosen(place, kind, _filled(text, cells).strip())
    numbers = _numbers(text, cells)
    if kind == "FLOAT" and getattr(place.kind, "unit", "") == "ROTATION":
        numbers = [math.radians(each) for each in numbers]
    if kind == "INT":
        numbers = [_whole(each) for each in numbers]
    if kind == "BOOLEAN":
        numbers = [each != 0 for each in numbers]
    return _fitting(place, numbers)


def shown(place: Place) -> str:
    """Return what a property is as a cell would say it: angles in degrees, datablocks by name."""
    value = value_at(place)
    if value is None:
        return ""
    if isinstance(value, bpy.types.ID):
        return value.name
    if isinstance(value, str):
        return value
    degrees = getattr(place.kind, "unit", "") == "ROTATION"
    numbers = [float(each) for each in (value if isinstance(value, list) else [value])]
    return " ".join(in_digits(math.degrees(each) if degrees else each) for each in numbers)


def variables_in(text: str, known) -> list[str]:
    """Return the variables that a text names."""
    return [name for name in VARIABLE.findall(text) if name in known]


def subject_of(mapping) -> str:
    """Return what a mapping sets, as the beginning of a sentence: Location Z of the object Lamp."""
    return mapping.name or mapping.path


def subject(thing, path: str, index: int) -> str:
    """Return what a property is called: Location Z of the object Lamp."""
    place = found_at(thing, path, index, path)
    name = place.name.replace("_", " ") if place.kind is None else place.kind.name
    if index >= 0:
        letters = _AXES.get(getattr(place.kind, "subtype", ""), "XYZW")
        name = f"{name} {letters[index]}" if index < len(letters) else f"{name} {index + 1}"
    inner = getattr(place.owner, "name", "") if place.owner != thing else ""
    part = f" of {inner}" if inner and inner != thing.name else ""
    return f"{name}{part} of the {thing_word(thing)} {thing.name}"


def thing_word(thing) -> str:
    """Return what a datablock is, in small letters: object, light, camera."""
    kinds = {"Key": "shapes", "ShaderNodeTree": "nodes", "GeometryNodeTree": "nodes"}
    for kind in ("Object", "Light", "Camera", "Material", "World", "Mesh", "Scene"):
        if isinstance(thing, getattr(bpy.types, kind)):
            return kind.lower()
    name = type(thing).__name__
    return kinds.get(name, name.lower())


def _type(place: Place) -> str:
    if place.kind is not None:
        return place.kind.type
    value = value_at(place)
    one = value[0] if isinstance(value, list) and value else value
    kinds = ((bool, "BOOLEAN"), (int, "INT"), (float, "FLOAT"), (str, "STRING"))
    return next((name for kind, name in kinds if isinstance(one, kind)), "POINTER")


def _filled(text: str, cells: Mapping[str, str]) -> str:
    for name in VARIABLE.findall(text):
        if name not in cells:
            raise RecipeError(f"no variable is called {name}, there are {choices(name, cells)}")
    return VARIABLE.sub(lambda found: cells[found[1]], text)


def _numbers(text: str, cells: Mapping[str, str]) -> list[float]:
    """Return the numbers that arithmetic with a condition's cells comes to."""
    found = VARIABLE.fullmatch(text.strip())
    plain = cells[found[1]] if found and found[1] in cells else text
    if plain.strip().lower() in _WORDS:
        return [float(_WORDS[plain.strip().lower()])]
    if known := numbers_of(plain):
        return known
    from ..mappings.expressions import evaluate  # brings numpy, which enabling need not wait for

    def number(found: re.Match) -> str:
        if found[1] in cells:
            numbers = numbers_of(cells[found[1]])
            if not numbers:
                raise RecipeError(f"'{cells[found[1]]}' of {found[1]} is no number")
            return f"[{' '.join(map(repr, numbers))}]" if len(numbers) > 1 else f"({numbers[0]!r})"
        if re.fullmatch(r"[A-Za-z_]\w*", found[1]) and found[1] != "pi":
            raise RecipeError(f"no variable is called {found[1]}, there are {choices(found[1], cells)}")
        return found[0]

    try:
        value = evaluate(VARIABLE.sub(number, plain), {})
    except ValueError as error:
        raise RecipeError(str(error)) from error
    return [float(value)] if not hasattr(value, "ravel") else [float(each) for each in value.ravel()]


def _whole(number: float) -> int:
    if number != int(number):
        raise RecipeError(f"{number:g} is no whole number")
    return int(number)


def _fitting(place: Place, numbers: list):
    """Return numbers as a property takes them: one goes to all components, three leave alpha as it is."""
    now = value_at(place)
    if not isinstance(now, list):
        if len(numbers) != 1:
            raise RecipeError(f"it takes one number, not {len(numbers)}")
        return numbers[0]
    if len(numbers) == 1:
        return numbers * len(now)
    if len(numbers) == 3 and len(now) == 4 and getattr(place.kind, "subtype", "").startswith("COLOR"):
        return [*numbers, now[3]]
    if len(numbers) != len(now):
        raise RecipeError(f"it takes {len(now)} numbers, not {len(numbers)}")
    return numbers


def _chosen(place: Place, kind: str, text: str):
    """Return a text, a choice or a datablock as a property takes it."""
    if kind == "STRING":
        return text
    if kind == "ENUM":
        items = {each.identifier: each.name for each in place.kind.enum_items}
        for identifier, name in items.items():
            if text.casefold() in (identifier.casefold(), name.casefold()):
                return identifier
        raise RecipeError(f"'{text}' is none of {', '.join(items)}")
    if not text:
        return None
    for home in _homes(place):
        if (found := home.get(text)) is not None:
            return found
    known = [each.name for home in _homes(place) for each in home]
    raise RecipeError(f"nothing is called {text}, there are {choices(text, known)}")


def _homes(place: Place) -> list:
    """Return the lists of bpy.data that hold what a property may point to."""
    wanted = (
        type(value_at(place)) if place.kind is None else getattr(bpy.types, place.kind.fixed_type.identifier)
    )
    homes = []
    for each in bpy.data.bl_rna.properties:
        kind = getattr(bpy.types, each.fixed_type.identifier, None) if each.type == "COLLECTION" else None
        if kind is not None and (issubclass(kind, wanted) or issubclass(wanted, kind)):
            homes.append(getattr(bpy.data, each.identifier))
    return homes


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
