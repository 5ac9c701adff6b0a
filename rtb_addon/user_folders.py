"""Where this system keeps what a user's programs write: settings, and what can be found out again."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import NamedTuple

_OURS = "render-toolbox"


class _Place(NamedTuple):
    """A folder: the variable that names it, and where it is below the user's home where none does."""

    variable: str | None
    below_home: str


_SETTINGS = {
    "win32": _Place("APPDATA", "AppData/Roaming"),
    "darwin": _Place(None, "Library/Application Support"),
}
_CACHES = {
    "win32": _Place("LOCALAPPDATA", "AppData/Local"),
    "darwin": _Place(None, "Library/Caches"),
}


def settings_folder() -> Path:
    """Return our folder for what the user has decided; RuntimeError where nobody knows the user's home."""
    return _folder(_SETTINGS.get(sys.platform, _Place("XDG_CONFIG_HOME", ".config")))


def cache_folder() -> Path:
    """Return our folder for what can be found out again; RuntimeError as for settings."""
    return _folder(_CACHES.get(sys.platform, _Place("XDG_CACHE_HOME", ".cache")))


def _folder(place: _Place) -> Path:
    named = os.environ.get(place.variable) if place.variable else None
    return Path(named or Path.home() / place.below_home) / _OURS
