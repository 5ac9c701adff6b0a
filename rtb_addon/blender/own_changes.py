"""Changes of a scene that are ours and taken back, for a preview or a look: no edits of the user's."""

_come = False


def note() -> None:
    """Say that something was set that will be, or has been, taken back."""
    global _come
    _come = True


def have_come() -> bool:
    """Return whether there were any since this was last asked; Blender evaluates them a little later."""
    global _come
    come, _come = _come, False
    return come
