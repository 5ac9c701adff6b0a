"""
What each renderer makes of the vocabulary: exact, approximate (how), or absent.

Tests, ``check`` and the panels read this one table.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, NamedTuple


class Fidelity(NamedTuple):
    """How true a renderer is to one word of the vocabulary, and what differs in a few words."""

    level: Literal["exact", "approximate", "absent"]
    difference: str = ""


EXACT = Fidelity("exact")
ABSENT = Fidelity("absent")

# feature ("material matte", "light spot", "camera perspective" ...) -> renderer -> fidelity
TABLE: Mapping[str, Mapping[str, Fidelity]] = {
    "material matte": {"mitsuba": EXACT, "tracer": EXACT},
    "light point": {"mitsuba": EXACT, "tracer": EXACT},
    "light spot": {"mitsuba": EXACT, "tracer": EXACT},
    "light directional": {"mitsuba": EXACT, "tracer": EXACT},
    "light area": {"mitsuba": EXACT, "tracer": EXACT},
    "camera perspective": {"mitsuba": EXACT, "tracer": EXACT},
    "camera orthographic": {"mitsuba": EXACT, "tracer": EXACT},
}


def fidelity(renderer: str, feature: str) -> Fidelity:
    """Return how true a renderer is to a feature; absent when the table does not list it."""
    return TABLE.get(feature, {}).get(renderer.lower(), ABSENT)
