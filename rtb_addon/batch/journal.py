"""How far a batch is, when it will end, and what its log says of it."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field, replace

from ..background import Event
from ..recipe import Recipe
from ..recipe.options import section_words
from . import records
from .keys import versions_of

_ENDS = {"done", "cached", "failed"}


@dataclass
class Journal:
    """
    How far a batch is, and its log.

    Parameters
    ----------
    recipe : whose it is
    total : how many conditions it has to see to
    """

    recipe: Recipe
    total: int
    finished: int = 0
    _rendered: int = 0
    _fractions: dict[str, float] = field(default_factory=dict)
    _began: float = field(default_factory=time.monotonic)

    def stamped(self, event: Event) -> Event:
        """Return an event with the batch's totals and the expected time to its end."""
        if event.kind in _ENDS:
            self.finished += 1
            self._rendered += event.kind != "cached"
            self._fractions.pop(event.condition, None)
        elif event.condition:
            self._fractions[event.condition] = event.fraction
        renderer = ""
        if event.condition:
            renderer = self.recipe.options_of(self.recipe.conditions[event.condition]).renderer
        return replace(
            event, renderer=renderer, finished=self.finished, total=self.total, remaining=self._remaining()
        )

    def _remaining(self) -> float | None:
        under_way = sum(self._fractions.values())
        work = self._rendered + under_way
        left = self.total - self.finished - under_way
        if left <= 0:
            return 0.0
        return round((time.monotonic() - self._began) * left / work, 1) if work > 0 else None

    def note(self, event: Event) -> None:
        """Write an event of note into the recipe's log."""
        said = {
            name: value
            for name in ("condition", "renderer", "message", "details", "seconds", "file", "warnings")
            if (value := getattr(event, name))
        }
        if event.kind in {"started", "finished", "cancelled"} and not event.condition:
            said |= {"finished": event.finished, "total": event.total, **self._circumstances(event)}
        elif event.kind not in {"done", "failed"} and not event.message:
            return
        records.note(self.recipe.folder, event.kind, **said)

    def _circumstances(self, event: Event) -> dict:
        if event.kind != "started":
            return {}
        name = self.recipe.overrides.get("renderer", self.recipe.options.renderer)
        return {
            "library version": records.library_version(),
            "renderer": name,
            **versions_of(self.recipe, name),
            "options": section_words(self.recipe.options) | dict(self.recipe.overrides),
            "process": os.getpid(),
        }
