"""The properties that conditions set, set for one of them and taken back to the bit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from ..errors import RecipeError
from . import own_changes
from .place_values import meant
from .places import (
    Place,
    changed_along,
    give_back,
    kept_value,
    place_of,
    refuse_fixed,
    set_value,
    subject_of,
)
from .table_edits import cells_of


def cells_by_name(settings, row) -> dict[str, str]:
    """Return what a row of the table says, by variable."""
    return dict(zip((each.name for each in settings.variables), cells_of(settings, row), strict=True))


def values_for(settings, cells: Mapping[str, str]) -> list[tuple[Place, object]]:
    """Return what the mappings of a scene set in a condition; raise what one of them cannot."""
    return [value_for(mapping, cells) for mapping in settings.mappings]


def value_for(mapping, cells: Mapping[str, str]) -> tuple[Place, object]:
    """Return what one mapping sets in a condition."""
    place = place_of(mapping)
    refuse_fixed(place, mapping.thing, mapping.path, subject_of(mapping))
    try:
        return place, meant(place, mapping.value, cells)
    except RecipeError as error:
        raise RecipeError(f"{subject_of(mapping)}: {error}") from error


@contextmanager
def set_for(settings, cells: Mapping[str, str]) -> Iterator[None]:
    """Let the properties be what a condition says, and afterwards what they were, the last one first."""
    before: list[tuple[Place, object]] = []
    try:
        for place, value in values_for(settings, cells):
            before += [(each, kept_value(each)) for *_, each in changed_along(place)]
            before.append((place, kept_value(place)))
            _set(place, value)
        yield
    finally:
        for place, value in reversed(before):
            give_back(place, value)
        own_changes.note()


def _set(place: Place, value) -> None:
    try:
        set_value(place, value)
    except (TypeError, ValueError, AttributeError, OverflowError) as error:
        raise RecipeError(f"{place.name} cannot be {value}: {' '.join(str(error).split())}") from error
