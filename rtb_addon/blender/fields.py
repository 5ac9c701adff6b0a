"""Where spectra are typed: the properties that hold one as text, and how it is seen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ..errors import RecipeError
from .conditions import VARIABLE
from .folders import typed
from .material_words import is_typed, parameters, takes_texture, texture_of, words_of
from .table_properties import spoken_cell


class Field(NamedTuple):
    """
    A property that holds a spectrum as text.

    Parameters
    ----------
    thing : what has it, and is active where it is shown
    name : of the property
    variable : what its variable is called where conditions vary it
    shines : whether it is light, and not what a surface does with light
    within : the group of the thing's properties that has it; empty for the thing's own
    index : whether it is an index of refraction or extinction, and not a part of the light
    """

    thing: str
    name: str
    variable: str
    shines: bool
    within: str = ""
    index: bool = False


def _of_materials() -> Iterator[tuple[str, Field]]:
    for parameter, each in parameters():
        name = words_of(parameter).name
        if is_typed(each.kind):
            yield name.upper(), Field("material", name, name, False, index=name in INDICES)
        if takes_texture(parameter, each.kind):
            within = texture_of(name)
            for own in ("even", "odd"):
                yield f"{name}_{own}".upper(), Field("material", own, f"{own}_{name}", False, within)


INDICES = ("eta", "k", "ior")
FIELDS = {
    "REFLECTANCE": Field("material", "reflectance", "reflectance", False),
    "LIGHT": Field("light", "spectrum", "light", True),
    "WORLD": Field("world", "spectrum", "world", True),
    "EMISSION": Field("object", "spectrum", "emission", True),
    "CELL": Field("scene", "value", "", False),
}
FIELDS.update(dict(_of_materials()))
ITEMS = tuple(
    (key, f"{each.thing.title()} {each.variable.replace('_', ' ').title()}".strip(), "", number)
    for number, (key, each) in enumerate(FIELDS.items(), 1)
)
_GROUPS = {
    "material": "RTB_PG_material",
    "light": "RTB_PG_light",
    "world": "RTB_PG_world",
    "object": "RTB_PG_object",
}


def field_of(group, name: str) -> str | None:
    """Return which field a property of a property group is, None if it is no spectrum."""
    kind = type(group).__name__
    for key, field in FIELDS.items():
        if field.name == name and field.thing in _GROUPS:
            if not field.within and kind == _GROUPS[field.thing]:
                return key
            if (
                field.within
                and kind == "RTB_PG_texture"
                and group == getattr(group.id_data.rtb, field.within)
            ):
                return key
    return None


def fields_of(thing: str) -> Iterator[Field]:
    """Yield the fields that things of a kind have."""
    yield from (field for field in FIELDS.values() if field.thing == thing)


def owner_of(context, key: str):
    """Return the property group that has a field, of what is active where the context is."""
    field = FIELDS[key]
    thing = active(context, field.thing)
    if thing is None:
        raise RecipeError(f"no {field.thing} is active here, select one first")
    if thing.library is not None:
        raise RecipeError(f"{thing.name} is linked from another file, change it there")
    return _active_cell(thing.rtb) if key == "CELL" else group_of(thing, field)


def group_of(thing, field: Field):
    """Return the property group of a thing that has a field."""
    return getattr(thing.rtb, field.within) if field.within else thing.rtb


def typed_in(group, name: str, settings) -> str:
    """Return what a field says in the active condition, with variables filled in and paths whole."""
    text = VARIABLE.sub(lambda found: _cell(settings, found[1], found[0]), getattr(group, name))
    return typed(text, group.id_data)


def is_number(text: str) -> bool:
    """Whether a text is a plain number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def varies(text: str) -> bool:
    """Whether a text names variables of the conditions."""
    return VARIABLE.search(text) is not None


def active(context, kind: str):
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
    return spoken_cell(settings.variables[number], settings.conditions[row].cells[number].value)
