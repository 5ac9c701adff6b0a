"""Names that Mitsuba accepts, one for each thing of a scene."""

from __future__ import annotations

import re
from itertools import chain, count

from ....errors import RecipeError


class Names:
    """Hands out ids of letters, digits, - and _, unique over the whole file, and remembers them."""

    def __init__(self) -> None:
        self._given: dict[tuple[str, str], str] = {}
        self._taken: set[str] = set()

    def of(self, kind: str, name: str) -> str:
        """Return a new id for a thing of some kind, as near to its name as may be."""
        clean = re.sub(r"[^A-Za-z0-9_-]", "_", name)
        # Names that begin otherwise are Mitsuba's own.
        clean = clean if clean[:1].isalpha() else f"{kind}_{clean}"
        # An id that is taken by another kind of thing is told apart by the kind, then by a number.
        numbered = (f"{clean}-{kind}-{k}" for k in count(2))
        for candidate in chain((clean, f"{clean}-{kind}"), numbered):
            if candidate.lower() not in self._taken:
                break
        self._taken.add(candidate.lower())
        self._given[kind, name] = candidate
        return candidate

    def of_once(self, kind: str, name: str) -> str:
        """Return the id that a thing was given, or a new one for a thing that nothing stands for."""
        return self._given.get((kind, name)) or self.of(kind, name)

    def known(self, kind: str, name: str, asker: str) -> str:
        """Return the id that a thing was given, for something that refers to it."""
        try:
            return self._given[kind, name]
        except KeyError:
            raise RecipeError(f"{asker} wants {kind} {name}, which the scene does not have") from None
