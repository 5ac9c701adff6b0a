"""Where spectra are typed: the properties that hold one as text, and how it is seen."""

from __future__ import annotations

import re
from typing import NamedTuple

from ..errors import RecipeError
from .folders import typed

_VARIABLE = re.compile(r"\(([^()]+)\)")


class Field(NamedTuple):
    """
    A property that holds a spectrum as text.

    Parameters
    ----------
    thing : what has it, and is active where it is shown
    name : of the property
    variable : what its variable is called where conditions vary it
    shines : whether it is light, and not what a surface does with light
    """

    thing: str
    name: str
    variable: str
    shines: bool


FIELDS = {
    "REFLECTANCE": Field("material", "reflectance", "reflectance", False),
    "LIGHT": Field("light", "spectrum", "light", True),
    "WORLD": Field("world", "spectrum", "world", True),
    "EMISSION": Field("object", "spectrum", "emission", True),
    "CELL": Field("scene", "value", "", False),
}
ITEMS = (
    ("REFLECTANCE", "Reflectance", "Of the active material", 1),
    ("LIGHT", "Light", "Of the active lamp", 2),
    ("WORLD", "World", "Of the scene's world", 3),
    ("EMISSION", "Emission", "Of the active mesh", 4),
    ("CELL", "Cell", "Of the active condition, for the active variable", 5),
)
_GROUPS = {
    ("RTB_PG_material", "reflectance"): "REFLECTANCE",
    ("RTB_PG_light", "spectrum"): "LIGHT",
    ("RTB_PG_world", "spectrum"): "WORLD",
    ("RTB_PG_object", "spectrum"): "EMISSION",
}


def field_of(group, name: str) -> str | None:
    """Return which field a property of a property group is, None if it is no spectrum."""
    return _GROUPS.get((type(group).__name__, name))


def owner_of(context, field: str):
    """Return the property group that has a field, of what is active where the context is."""
    thing = _thing(context, FIELDS[field].thing)
    if thing is None:
        raise RecipeError(f"no {FIELDS[field].thing} is active here, select one first")
    if thing.library is not None:
        raise RecipeError(f"{thing.name} is linked from another file, change it there")
    return _active_cell(thing.rtb) if field == "CELL" else thing.rtb


def typed_in(group, name: str, settings) -> str:
    """Return what a field says in the active condition, with variables filled in and paths whole."""
    text = _VARIABLE.sub(lambda found: _cell(settings, found[1], found[0]), getattr(group, name))
    return typed(text, group.id_data)


def varies(text: str) -> bool:
    """Whether a text names variables of the conditions."""
    return _VARIABLE.search(text) is not None


def _thing(context, kind: str):
    """Return the active thing of a kind; where the editor knows none, that of the active object."""
    if (found := getattr(context, kind, None)) is not None:
        return found
    body = getattr(context, "object", None)
    if kind == "world":
        return context.scene.world
    if kind == "material" and body is not None:
        return body.active_material
    return body.data if kind == "light" and body is not None and body.type == "LIGHT" else None


def _active_cell(settings):
    row, number = settings.active_condition, settings.active_variable
    if row >= len(settings.conditions) or number >= len(settings.conditions[row].cells):
        raise RecipeError("no cell of the conditions is active, add a variable first")
    return settings.conditions[row].cells[number]


def _cell(settings, variable: str, otherwise: str) -> str:
    """Return the active condition's cell for a variable."""
    number = settings.variables.find(variable)
    row = settings.active_condition
    if number < 0 or row >= len(settings.conditions) or number >= len(settings.conditions[row].cells):
        return otherwise
    return settings.conditions[row].cells[number].value
