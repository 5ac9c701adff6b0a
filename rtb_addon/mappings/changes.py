"""RenderToolbox4's mappings: a JSON array of objects, each of which changes one element."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn

from ..errors import RecipeError, at

OPERATIONS = ("create", "update", "delete", "blessAsAreaLight", "blessAsBumpMap")
_BLANK = re.compile(r"[ \t\r\n]*")
# Field of a Change -> key in the file.
_KEYS = {
    "name": "name",
    "broad_type": "broadType",
    "specific_type": "specificType",
    "operation": "operation",
    "group": "group",
    "destination": "destination",
}


@dataclass(frozen=True)
class ChangedProperty:
    """
    One property of a change.

    Parameters
    ----------
    value : as JSON has it: a text, a number, an array, or None for nothing
    operation : ``=``, or an expression of oldValue and value
    """

    name: str
    value_type: str = ""
    value: Any = None
    operation: str = "="


@dataclass(frozen=True)
class Change:
    """
    What one object of the array says.

    Parameters
    ----------
    name : of the element, as the modeller calls it
    index : of the element among those of its kind, from 1; None where a name tells
    broad_type, specific_type : kind and model of the element
    operation : one of OPERATIONS
    destination : mexximp (the parent scene), Generic, or a renderer
    line : where it begins
    """

    name: str = ""
    index: int | None = None
    broad_type: str = ""
    specific_type: str = ""
    operation: str = "create"
    group: str = ""
    destination: str = "Generic"
    properties: tuple[ChangedProperty, ...] = ()
    line: int = field(default=0, compare=False)

    def applies(self, group: str) -> bool:
        """Return whether it counts for a condition of a group; all count where there is none."""
        return not group or not self.group or group == self.group


def parse_changes(text: str, file: str | Path) -> tuple[Change, ...]:
    """Return a file's changes; raise what is wrong with them."""
    try:
        return tuple(_change(words, file, line) for words, line in _objects(text, file))
    except RecursionError:
        raise RecipeError("its JSON is nested too deeply", file) from None


def format_changes(changes: Iterable[Change]) -> str:
    """Return the text that parse_changes() reads back as the same changes."""
    return json.dumps([_words(change) for change in changes], indent=2, ensure_ascii=False) + "\n"


def _objects(text: str, file: str | Path) -> Iterator[tuple[Any, int]]:
    """Yield the elements of the array, each with its line."""
    decoder = json.JSONDecoder(parse_constant=_refuse_constant)
    place = _after_blanks(text, 0)
    if text[place : place + 1] != "[":
        raise RecipeError("want an array of mappings, [ { ... }, { ... } ]", file, _line(text, place))
    place = _after_blanks(text, place + 1)
    if text[place : place + 1] == "]":
        return _refuse_rest(text, place + 1, file)
    while True:
        with at(file, _line(text, place)):
            try:
                found, end = decoder.raw_decode(text, place)
            except json.JSONDecodeError as error:
                raise RecipeError(f"{error.msg}, it must be JSON", file, error.lineno) from error
        yield found, _line(text, place)
        place = _after_blanks(text, end)
        if text[place : place + 1] == "]":
            return _refuse_rest(text, place + 1, file)
        if text[place : place + 1] != ",":
            raise RecipeError("want , or ] after a mapping", file, _line(text, place))
        place = _after_blanks(text, place + 1)


def _refuse_rest(text: str, place: int, file: str | Path) -> None:
    if text[place:].strip():
        raise RecipeError("something follows the array", file, _line(text, _after_blanks(text, place)))


def _after_blanks(text: str, place: int) -> int:
    found = _BLANK.match(text, place)
    return found.end() if found else place


def _line(text: str, place: int) -> int:
    return text.count("\n", 0, place) + 1


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")


def _change(words: Any, file: str | Path, line: int) -> Change:
    with at(file, line):
        if not isinstance(words, Mapping):
            raise ValueError("a mapping is an object, { ... }")
        texts = {name: _text(words, key) for name, key in _KEYS.items() if key in words}
        change = Change(
            **texts, index=_index(words), properties=tuple(_properties(words.get("properties"))), line=line
        )
        if change.operation not in OPERATIONS:
            raise ValueError(f"operation is '{change.operation}', want one of {', '.join(OPERATIONS)}")
        return change


def _properties(listed: Any) -> Iterator[ChangedProperty]:
    for words in listed if isinstance(listed, list) else [] if listed is None else [listed]:
        if not isinstance(words, Mapping) or not words.get("name"):
            raise ValueError("a property is an object with a name, such as intensity")
        operation = _text(words, "operation") if "operation" in words else "="
        name, kind = _text(words, "name"), _text(words, "valueType") if "valueType" in words else ""
        yield ChangedProperty(name, kind, words.get("value"), operation)


def _text(words: Mapping[str, Any], key: str) -> str:
    if not isinstance(words[key], str):
        raise ValueError(f"{key} is {json.dumps(words[key])[:40]}, want a text")
    return words[key]


def _index(words: Mapping[str, Any]) -> int | None:
    index = words.get("index")
    if index is None or index == []:
        return None
    if isinstance(index, bool) or not isinstance(index, int | float) or index < 1 or index != int(index):
        raise ValueError(f"index is {json.dumps(index)[:40]}, want a whole number from 1")
    return int(index)


def _words(change: Change) -> dict[str, Any]:
    words = {key: getattr(change, name) for name, key in _KEYS.items()}
    words = {key: text for key, text in words.items() if text or key in ("operation", "destination")}
    if change.index is not None:
        words["index"] = change.index
    if change.properties:
        words["properties"] = [_property_words(each) for each in change.properties]
    return words


def _property_words(each: ChangedProperty) -> dict[str, Any]:
    words = {
        "name": each.name,
        "valueType": each.value_type,
        "value": each.value,
        "operation": each.operation,
    }
    empty = {"valueType": "", "value": None, "operation": "="}
    return {key: value for key, value in words.items() if key not in empty or value != empty[key]}
