"""What a sentence about a recipe speaks of, so that a button can select it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import bpy

from . import row_states

# Kinds of things as sentences name them, and where they are kept; what is in the scene is looked for first.
HOMES = {
    "object": "objects",
    "camera": "objects",
    "material": "materials",
    "light": "lights",
    "world": "worlds",
}
_SUFFIXES = {"-material": "material", "-light": "light", "-mesh": "mesh", "-camera": "camera"}
_ROW = re.compile(r"\bconditions\.txt:(\d+)\b")
_LINE = re.compile(r"\bmappings\.(?:txt|json):(\d+)\b")


class Culprit(NamedTuple):
    """
    What a finding is about.

    Parameters
    ----------
    kind : object, material, light, world, condition, mapping (a property that varies) or line (of the text)
    name : of it; a number from 0 for mappings, from 1 for lines
    """

    kind: str
    name: str


def culprit_of(sentence: str, scene, mappings: Sequence[str] = (), generated: int = 0) -> Culprit | None:
    """
    Return what a sentence speaks of, None where it names nothing that can be selected.

    Parameters
    ----------
    mappings : lines of the mappings file as it was written
    generated : how many of them are not of the scene's text
    """
    if (found := _LINE.search(sentence)) and 1 <= (line := int(found[1])) <= len(mappings):
        if line > generated:
            return Culprit("line", str(line - generated))
        return _by_id(mappings[line - 1])
    return _mapping(sentence, scene) or _condition(sentence, scene) or _named(sentence) or _by_id(sentence)


def _mapping(sentence: str, scene) -> Culprit | None:
    from ..rtb_addon.blender.places import subject_of

    for number, mapping in enumerate(scene.rtb.mappings):
        if sentence.startswith(f"{subject_of(mapping)}: "):
            return Culprit("mapping", str(number))
    return None


def _condition(sentence: str, scene) -> Culprit | None:
    names = [row_states.row_name(scene, row, number) for number, row in enumerate(scene.rtb.conditions)]
    if (found := _ROW.search(sentence)) and 1 <= (row := int(found[1]) - 1) <= len(names):
        return Culprit("condition", names[row - 1])
    said = [name for name in names if sentence.startswith(f"{name}: ")]
    name = said[0] if said else _longest(sentence, "condition", names)
    return Culprit("condition", name) if name else None


def _named(sentence: str) -> Culprit | None:
    for kind, home in HOMES.items():
        if name := _longest(sentence, kind, (each.name_full for each in getattr(bpy.data, home))):
            return Culprit("object" if kind == "camera" else kind, name)
    return None


def _by_id(sentence: str) -> Culprit | None:
    """Find what an id of the parent scene belongs to, as in Paint-material."""
    from ..rtb_addon.scene.collada.ids import clean

    homes = {"material": "materials", "light": "lights", "mesh": "objects", "camera": "objects"}
    for suffix, kind in _SUFFIXES.items():
        for thing in getattr(bpy.data, homes[kind]):
            name = thing.data.name if kind in ("mesh", "camera") and thing.data else thing.name
            if re.search(rf"(?<![\w-]){re.escape(clean(name) + suffix)}(?![\w-])", sentence):
                return Culprit("object" if kind in ("mesh", "camera") else kind, thing.name)
    return None


def _longest(sentence: str, kind: str, names: Iterable[str]) -> str:
    """Return the longest of some names that stands behind its kind in a sentence."""
    said = [name for name in names if name and re.search(rf"\b{kind} {re.escape(name)}(?![\w.])", sentence)]
    return max(said, key=len, default="")
