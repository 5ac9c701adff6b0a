"""
Mitsuba's numbers of the objects of a scene, by which tables are looked up.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import drjit as dr
import mitsuba as mi
import numpy as np


def number_of(pointer) -> int:
    """Return Mitsuba's number of the object that a pointer points to."""
    return int(numbers_of(pointer)[0])


def numbers_of(pointer) -> Any:
    """Return Mitsuba's numbers of the objects that pointers point to; 0 is none."""
    return dr.reinterpret_array(mi.UInt32, pointer)


def by_number(pointers: Mapping[str, Any], marks: Mapping[str, int]) -> Any:
    """Return a table from Mitsuba's numbers of objects to marks of ours; 0 where there is none."""
    numbers = {id: number_of(pointer) for id, pointer in pointers.items()}
    table = np.zeros(max(numbers.values(), default=0) + 1, np.uint32)
    for id, number in numbers.items():
        table[number] = marks.get(id, 0)
    return mi.UInt32(table)


def rows_by_number(pointers: Mapping[str, Any], ids: Iterable[str]) -> Any:
    """Return a table from Mitsuba's numbers of objects to our rows, which are in the order of ids."""
    return by_number(pointers, {id: row for row, id in enumerate(ids)})
