"""
One line of a mappings file.

A line without operator declares, a line with one configures. Operators stand between plain spaces:
``a=b`` holds none, so that paths may hold ``|sid=location``.
"""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

_OPERATOR = re.compile(r" (=|\+=|-=|\*=|/=) ")
_BRACKETS: tuple[tuple[Literal["<>", "[]"], re.Pattern[str]], ...] = (
    ("<>", re.compile(r"<(.*)>")),
    ("[]", re.compile(r"\[(.*)\]")),
)


class Side(NamedTuple):
    """One side of a line: its value, and the brackets that enclosed it if any."""

    value: str
    enclosing: Literal["", "[]", "<>"] = ""


class Statement(NamedTuple):
    """A line taken apart; the operator is empty in a declaration, which has no right side."""

    left: Side
    operator: str = ""
    right: Side = Side("")


class Target(NamedTuple):
    """
    ``id:name:type`` or ``id:name``; any of ``. : $`` may stand between the parts.

    Parameters
    ----------
    name, type : category and model in a declaration, property and value type in a configuration
    """

    id: str
    name: str
    type: str


def parse_statement(text: str) -> Statement:
    """Return a line's two sides and its operator, the first one; ValueError for half a bracket."""
    if (found := _OPERATOR.search(text)) is None:
        return Statement(_side(text))
    return Statement(_side(text[: found.start()]), found[1], _side(text[found.end() :]))


def parse_target(text: str) -> Target:
    """Return the parts of a scene target; ValueError where they are too few, too many or empty."""
    parts = [part.strip() for part in re.split(r"[.:$]", text)]
    if len(parts) not in (2, 3) or not all(parts):
        raise ValueError(f"cannot read '{text}', want id:category:type or id:property.type = value")
    return Target(parts[0], parts[1], parts[2] if len(parts) == 3 else "")


def count_parts(text: str) -> int:
    """Return how many parts a scene target has; 0 where one is empty."""
    parts = [part.strip() for part in re.split(r"[.:$]", text)]
    return len(parts) if all(parts) else 0


def _side(text: str) -> Side:
    for enclosing, pattern in _BRACKETS:
        if found := pattern.search(text):
            return Side(found[1], enclosing)
        if enclosing[0] in text:
            raise ValueError(f"'{enclosing[0]}' without its '{enclosing[1]}' in '{text.strip()}'")
    return Side(text.strip())
