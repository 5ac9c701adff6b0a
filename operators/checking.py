"""
The check that is under way, if any.

It lives here and not in Blender's data, so that undo and saving do not touch it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .child_verb import ChildVerb

child: ChildVerb | None = None


def stop() -> None:
    """End the check now, for the file or the extension is about to go."""
    global child
    if child is not None:
        child.stop()
        child = None
