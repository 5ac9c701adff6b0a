"""recipe.json: what it says, and what it says that nobody knows."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

from ..errors import RecipeError
from .options import Conventions, MontageOptions, RecipeOptions, section, section_words

FORMAT = 1
RECIPE = "recipe.json"
_SECTIONS = {"options": RecipeOptions, "conventions": Conventions, "montage": MontageOptions}
_KNOWN = {"format", "name", "renderer", "provenance", *_SECTIONS}


def words_of(
    name: str, sections: Mapping[str, Any], provenance: Mapping[str, Any], old: Mapping[str, Any]
) -> dict[str, Any]:
    """Return what recipe.json is to say; keys of others that the old one had are kept."""
    new = {key: section_words(values) for key, values in sections.items()}
    renderer = new["options"].pop("renderer")
    kept = {key: {**old.get(key, {}), **words} for key, words in new.items()}
    said = {"format": FORMAT, "name": name, "renderer": renderer, **kept}
    return {
        **said,
        **{key: word for key, word in old.items() if key not in said},
        "provenance": dict(provenance),
    }


def unknown(words: Mapping[str, Any]) -> list[str]:
    """Return one sentence for each key that nobody knows."""
    found = [name for name in words if name not in _KNOWN]
    for name, kind in _SECTIONS.items():
        known = {item.name for item in fields(kind)} - {"renderer", "centres"}
        found += [f"{name}.{key}" for key in words.get(name, {}) if key not in known]
    return [f"{RECIPE}: {name} is kept, but means nothing to this version" for name in found]


def parsed(words: Any, default_name: str) -> dict[str, Any]:
    """Return what recipe.json says as a Recipe's fields; raise what is wrong with it."""
    if not isinstance(words, dict):
        raise RecipeError(f"it holds no object, it must begin with {{ and say format: {FORMAT}", RECIPE)
    version = words.get("format")
    if not isinstance(version, int) or not 1 <= version <= FORMAT:
        raise RecipeError(f"format is {json.dumps(version)}, this version reads format {FORMAT}", RECIPE)
    name = words.get("name", default_name)
    if not isinstance(name, str) or not name.strip() or any(letter in name for letter in '/\\:*?"<>|\0'):
        raise RecipeError(f"name is {json.dumps(name)}, it must be a text fit for a file's name", RECIPE)
    provenance = words.get("provenance", {})
    if not isinstance(provenance, dict):
        raise RecipeError("provenance must be an object of names and values", RECIPE)
    sections = {key: _parsed_section(words, key) for key in _SECTIONS}
    return {"name": name, "provenance": provenance, "words": words, **sections}


def _parsed_section(words: Mapping[str, Any], name: str) -> Any:
    said = words.get(name, {})
    if not isinstance(said, dict):
        raise RecipeError(f"{name} must be an object of names and values", RECIPE)
    if name == "options" and "renderer" in words:
        said = {**said, "renderer": words["renderer"]}
    try:
        return section(_SECTIONS[name], said)
    except ValueError as error:
        raise RecipeError(f"{name}: {error}", RECIPE) from error
