"""What stands beside a cube, in it, and in the log: how it came about."""

from __future__ import annotations

import json
import os
import tomllib
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from ..conditions import Condition
from ..exr import texts_of_whole
from ..files import write_text
from ..recipe import Recipe
from ..recipe.options import section_words
from ..spectral_image import UNIT
from .keys import Key

LOG = "log.jsonl"


def record(
    recipe: Recipe,
    condition: Condition,
    key: Key,
    warnings: tuple[str, ...],
    seconds: Mapping[str, float],
) -> dict[str, Any]:
    """Return how a condition was rendered, and in how many seconds [s], by name of the span."""
    return {
        "condition": condition.name,
        "key": key.digest,
        "cells": dict(condition.cells),
        "options": section_words(recipe.options_of(condition)),
        "conventions": section_words(recipe.conventions),
        "unit": UNIT,
        "mappings": key.applied,
        "files": dict(key.files),
        **({"remodeler": recipe.remodeler.digest} if recipe.remodeler else {}),
        "library version": library_version(),
        **key.versions,
        **{span: round(length, 3) for span, length in seconds.items()},
        "warnings": list(warnings),
        "date": _now(),
    }


def attributes(record: Mapping[str, Any]) -> dict[str, str]:
    """Return what of a record is written into the cube itself."""
    return {
        "condition": record["condition"],
        "key": record["key"],
        "renderer": record["options"]["renderer"],
        "renderer_version": record["renderer version"],
        "library_version": record["library version"],
        "units": record["conventions"]["units"],
        "handedness": record["conventions"]["handedness"],
    }


def key_in(cube: Path) -> str | None:
    """Return the key that is written in a cube, None when there is none or the file is not whole."""
    try:
        texts = texts_of_whole(cube)
    except OSError:
        return None
    return None if texts is None else texts.get("rtb.key")


def write(file: Path, record: Mapping[str, Any]) -> None:
    """Write a record beside its cube."""
    write_text(file, json.dumps(record, indent=2, ensure_ascii=False) + "\n")


def read(file: Path) -> dict[str, Any]:
    """Return a record, empty when there is none that can be read."""
    try:
        words = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return words if isinstance(words, dict) else {}


def note(folder: Path, what: str, **words: Any) -> None:
    """Append a line to a recipe's log, in which files of its folder go by their names there."""
    line = json.dumps({"when": _now(), "what": what, **words}, ensure_ascii=False)
    line = line.replace(json.dumps(f"{folder}{os.sep}", ensure_ascii=False)[1:-1], "")
    with (folder / LOG).open("a+b") as log:
        # A process that was killed may have left half a line; ours begins a new one.
        log.seek(max(log.tell() - 1, 0))
        broken = log.read(1) not in (b"", b"\n")
        log.write((b"\n" if broken else b"") + line.encode() + b"\n")


def library_version() -> str:
    """Return our own version."""
    manifest = Path(__file__).parents[2] / "blender_manifest.toml"
    if manifest.is_file():  # a checkout or an extension
        return str(tomllib.loads(manifest.read_text(encoding="utf-8"))["version"])
    return metadata.version("rtb_addon")


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")
