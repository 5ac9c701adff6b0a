"""Changes of a scene that are ours and taken back, for a preview or a look: no edits of the user's."""

import bpy

TURNS = 3  # of Blender's main loop within which it evaluates what has been set

_left = 0


def note() -> None:
    """Say that something was set that will be, or has been, taken back."""
    global _left
    _left = TURNS
    if not bpy.app.background and not bpy.app.timers.is_registered(_turn):
        bpy.app.timers.register(_turn, persistent=True)


def come_now() -> bool:
    """Return whether what Blender evaluates now is ours; without a window it does so once."""
    global _left
    ours = _left > 0
    if bpy.app.background:
        _left = 0
    return ours


def _turn() -> float | None:
    global _left
    _left -= 1
    return 0.0 if _left > 0 else None
