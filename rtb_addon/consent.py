"""
Which code that came with recipes this user has agreed to run, by the digest of its bytes.

It is kept in the user's own folder, where no recipe can write. A file that changes is another file.
"""

from __future__ import annotations

import hashlib
import json
import time
from typing import Any

from .files import write_text
from .user_folders import settings_folder

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


def _digest(code: bytes) -> str:
    return hashlib.sha256(code).hexdigest()


def _agreed() -> dict[str, Any]:
    try:
        words = json.loads((settings_folder() / STORE).read_text(encoding="utf-8"))
    except (OSError, ValueError, RuntimeError):  # the last where nobody knows the user's home
        return {}
    return words if isinstance(words, dict) else {}


def _write(agreed: dict[str, Any]) -> None:
    write_text(settings_folder() / STORE, json.dumps(agreed, indent=2, ensure_ascii=False) + "\n")
