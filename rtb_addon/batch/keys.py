"""
A condition's key: a digest of everything that its rendering comes from.

Same key, same rendering. No path of this machine and no time goes into it.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..conditions import Condition
from ..errors import RecipeError
from ..recipe import Recipe
from ..recipe.condition_scene import adjustments_of, renderer_of
from ..recipe.named_files import texture_names
from ..recipe.options import section_words
from ..recipe.remodeler import digest_of
from ..scene.adjustments import Adjustments

# Raised when the way from a folder to a RenderScene changes what comes out.
ENGINE = 3
# Where something was said, or that it was odd, does not change what was said.
_UNSAID = {"file", "line", "remarks"}
# A family says them once for all its conditions, or nearly.
_words_of = lru_cache(maxsize=16)(section_words)


class Key(NamedTuple):
    """
    A condition's key, and what was found on the way to it.

    Parameters
    ----------
    digest : 64 hexadecimal digits
    adjustments : the mappings that apply, filled in
    versions : of the renderer and of our translation for it
    files : name in the recipe -> digest of the file's bytes
    applied : the mappings that apply, as a record shows them
    """

    digest: str
    adjustments: Adjustments
    versions: Mapping[str, Any]
    files: Mapping[str, str]
    applied: Any


def key_of(recipe: Recipe, condition: Condition) -> Key:
    """Return a condition's key; raise what is wrong with its row, its mappings or its renderer."""
    options = recipe.options_of(condition)
    files: dict[str, str] = {}

    def find_file(name: str) -> Path | None:
        if (file := recipe.find_file(name)) is not None:
            files[name] = _digest_of(file)
        return file

    remodeler = digest_of(recipe)
    adjustments, applied = _applied(recipe, condition, find_file)
    parent = recipe.parent_file(condition)
    for name in texture_names(parent):
        with suppress(RecipeError):  # whether it is needed is for resolving to say
            find_file(name)
    versions = versions_of(recipe, options.renderer)
    inputs = {
        "engine": ENGINE,
        "parent": _digest_of(parent),
        "row": dict(condition.cells),
        "mappings": applied,
        "files": files,
        "options": _words_of(options),
        "conventions": _words_of(recipe.conventions),
        **versions,
    }
    if remodeler:
        inputs["remodeler"] = remodeler
    text = json.dumps(inputs, sort_keys=True)
    return Key(hashlib.sha256(text.encode()).hexdigest(), adjustments, versions, files, applied)


def _applied(
    recipe: Recipe, condition: Condition, find_file: Callable[[str], Path | None]
) -> tuple[Adjustments, Any]:
    """Return the mappings that apply to a condition, and what of them counts."""
    try:
        adjustments = adjustments_of(recipe, condition, find_file)
    except RecipeError:
        if not digest_of(recipe):
            raise
        # Nothing runs code only to tell a key: what the code makes right counts as it is written.
        return Adjustments(), recipe.mappings_of(condition).text
    return adjustments, plain(adjustments, recipe.folder)


def versions_of(recipe: Recipe, name: str) -> dict[str, Any]:
    """Return a renderer's version and our translation's for it; one sentence when it is not installed."""
    renderer = renderer_of(recipe, name)
    installed = recipe.once(("version", name), renderer.version)
    if installed.version is None:
        raise RecipeError(f"the renderer {name} cannot be used here: {installed.reason}")
    return {"renderer version": installed.version, "translation": renderer.translation}


def plain(value: Any, folder: Path) -> Any:
    """Return a value as JSON can write it, the same wherever the folder lies."""
    return _plain(value, str(folder))


def _plain(value: Any, folder: str) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        value = {item.name: getattr(value, item.name) for item in dataclasses.fields(value)}
    elif isinstance(value, tuple) and hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, Mapping):
        return {str(name): _plain(each, folder) for name, each in value.items() if name not in _UNSAID}
    if isinstance(value, list | tuple):
        return [_plain(each, folder) for each in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Path):
        return value.as_posix().removeprefix(Path(folder).as_posix() + "/")
    if isinstance(value, str):
        return value.replace(folder + os.sep, "")
    return value


def _digest_of(file: Path) -> str:
    return _digest(*_state_of(file))


def _state_of(file: Path) -> tuple[Path, int, int]:
    try:
        state = file.stat()
    except OSError as error:
        raise RecipeError(f"cannot read {file}: {error.strerror}") from error
    return file, state.st_size, state.st_mtime_ns


@cache
def _digest(file: Path, size: int, time: int) -> str:
    """Return the digest of a file's bytes; size and time only tell when to look again."""
    try:
        with file.open("rb") as content:
            return hashlib.file_digest(content, "sha256").hexdigest()
    except OSError as error:
        raise RecipeError(f"cannot read {file}: {error.strerror}") from error
