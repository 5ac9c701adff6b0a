"""Kept values written back to where they stood in a datablock of Blender."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np

from .kept_values import DATABLOCK, GONE, TYPES, UNSET, Where


def write_value(datablock, where: Where, value, known: Mapping[int, Any]) -> None:
    """
    Write a value back to where it was read.

    Parameters
    ----------
    known : datablocks by their numbers
    """
    *way, last = where
    struct = datablock
    for step in way:
        if isinstance(step, int) and step >= len(struct):
            raise LookupError  # before Blender prints a line about it
        struct = struct[step] if isinstance(step, int) else getattr(struct, step)
    if isinstance(last, tuple):
        _write_special(struct, last, value, known)
    elif isinstance(value, tuple) and isinstance(getattr(struct, last), bpy.types.bpy_prop_collection):
        _write_list(getattr(struct, last), [_meant(each, known) for each in value])
    elif isinstance(value, str) and value == UNSET:
        struct.property_unset(last)
    elif last == "frame_current":
        datablock.frame_set(value)
    elif last == "animation_data" and value is None:
        struct.animation_data_clear()
    elif getattr(struct.bl_rna.properties[last], "is_enum_flag", False):
        setattr(struct, last, {each for _, each in value})
    else:
        setattr(struct, last, _meant(value, known))


def _write_special(struct, last: tuple, value, known: Mapping[int, Any]) -> None:
    """Write a custom property, a column of a long list, or take away what came to a list."""
    kind, *name = last
    if kind == "key":
        # A number that is there keeps its type, whatever is written into it.
        plain = isinstance(value, (bool, int, float))
        if value == GONE or (plain and name[0] in struct and type(struct[name[0]]) is not type(value)):
            del struct[name[0]]
        if value != GONE:
            struct[name[0]] = _meant(value, known)
    elif kind == "each":
        prop = struct[0].bl_rna.properties[name[0]]
        struct.foreach_set(name[0], np.frombuffer(value, TYPES[prop.type]))
        struct.id_data.update_tag()
    elif kind == "items":
        _take_away(struct, value)


def _take_away(items, wanted: tuple) -> None:
    """Remove the items of a list that it did not have."""
    left = Counter(wanted[1:])
    extra = []
    for index, each in enumerate(items):
        name = getattr(each, "name", "")
        left[name] -= 1
        if left[name] < 0:
            extra.append(index)
    for index in reversed(extra):
        try:
            items.remove(items[index])
        except TypeError:
            items.remove(index)


def _write_list(items, wanted: list) -> None:
    """Let a list hold just these datablocks, in this order."""
    if hasattr(items, "link"):
        for each in list(items):
            items.unlink(each)
        for each in wanted:
            items.link(each)
        return
    while len(items) > len(wanted):
        items.pop(index=len(items) - 1)
    for index, each in enumerate(wanted):
        if index < len(items):
            items[index] = each
        else:
            items.append(each)


def _meant(value, known: Mapping[int, Any]):
    """Return a kept value as Blender takes it."""
    if isinstance(value, tuple) and len(value) == 2 and value[0] == DATABLOCK:
        return known[value[1]]
    if isinstance(value, dict):
        return {name: _meant(each, known) for name, each in value.items()}
    return value
