"""What the text of a mapping comes to for a property, and what a property is as a text."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import bpy

from ..errors import RecipeError, choices
from .conditions import VARIABLE
from .places import Place, value_at
from .table_properties import in_digits, numbers_of

_NUMBERS = ("FLOAT", "INT", "BOOLEAN")
_WORDS = {"true": 1, "yes": 1, "on": 1, "false": 0, "no": 0, "off": 0}


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
