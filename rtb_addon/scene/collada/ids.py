"""Ids of a Collada document, as Blender's exporter made them from names."""

from __future__ import annotations

import re
from collections.abc import Iterable

_FIRST = re.compile(r"[^\W\d]")
_ILLEGAL = re.compile(r"[^\w-]")


def clean(name: str) -> str:
    """Return a name as part of an id: what XML or a path in mappings cannot hold becomes ``_``."""
    cleaned = _ILLEGAL.sub("_", name) or "_"
    return cleaned if _FIRST.match(cleaned) else "_" + cleaned[1:]


class Ids:
    """
    The ids that are taken in a document.

    A name that is taken gets the number 2, 3 ... as Blender's exporter gave it: ``a_b``, ``a_b2``.
    """

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._reserved: dict[tuple[str, str], str] = {}

    def reserve(self, names: Iterable[str], suffix: str = "") -> None:
        """Give out the ids of several names at once: names that need no cleaning keep their own."""
        for name in sorted(set(names), key=lambda name: (clean(name) != name, name)):
            self._reserved[name, suffix] = self._free(name, suffix)

    def take(self, name: str, suffix: str = "") -> str:
        """Return the id that was reserved for a name, once; else a free one."""
        return self._reserved.pop((name, suffix), None) or self._free(name, suffix)

    def _free(self, name: str, suffix: str) -> str:
        base, number = clean(name), 1
        while (found := f"{base}{number if number > 1 else ''}{suffix}") in self._taken:
            number += 1
        self._taken.add(found)
        return found
