"""
Which code that came with recipes this user has agreed to run, by the digest of its bytes.

It is kept in the user's own folder, where no recipe can write. A file that changes is another file.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import time
from pathlib import Path
from typing import Any

from .files import write_text

STORE = "trusted-code.json"


def has_consent(code: bytes) -> bool:
    """Return whether the user has agreed to run just this code."""
    return _digest(code) in _agreed()


def give_consent(code: bytes, name: str) -> None:
    """Remember that the user has read this code and agrees to run it; the name is for people."""
    now = time.strftime("%Y-%m-%d %H:%M:%S")
    _write({**_agreed(), _digest(code): {"name": name, "since": now}})


def withdraw_consent(code: bytes) -> None:
    """Forget that the user agreed to run this code."""
    _write({digest: words for digest, words in _agreed().items() if digest != _digest(code)})


def user_folder() -> Path:
    """Return where this system keeps a user's settings of programs, a folder of ours in it."""
    if sys.platform == "win32":
        place = Path(os.environ.get("APPDATA") or Path.home() / "AppData" / "Roaming")
    elif sys.platform == "darwin":
        place = Path.home() / "Library" / "Application Support"
    else:
        place = Path(os.environ.get("XDG_CONFIG_HOME") or Path.home() / ".config")
    return place / "render-toolbox"


def _digest(code: bytes) -> str:
    return hashlib.sha256(code).hexdigest()


def _agreed() -> dict[str, Any]:
    try:
        words = json.loads((user_folder() / STORE).read_text(encoding="utf-8"))
    except (OSError, ValueError, RuntimeError):  # the last where nobody knows the user's home
        return {}
    return words if isinstance(words, dict) else {}


def _write(agreed: dict[str, Any]) -> None:
    write_text(user_folder() / STORE, json.dumps(agreed, indent=2, ensure_ascii=False) + "\n")
