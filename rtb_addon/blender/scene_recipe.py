"""A recipe that a scene of Blender's holds, in plain data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..conditions import Conditions
from ..errors import RecipeError
from ..recipe import Conventions, MontageOptions, RecipeOptions, write_recipe


@dataclass(frozen=True)
class SceneRecipe:
    """
    A recipe that a scene holds, ready to be written.

    Parameters
    ----------
    parent : the parent scene, Collada 1.4.1
    mappings : text of the mappings file
    generated : how many of its lines are made from what the scene says elsewhere, the first ones
    resources : contents of files by their names below resources/
    report : what had to be assumed or is left out, a sentence each
    folder : where it is saved unless said otherwise, or why there is no such place
    """

    name: str
    options: RecipeOptions
    conventions: Conventions
    montage: MontageOptions
    parent: bytes
    conditions: Conditions
    mappings: str
    generated: int
    resources: Mapping[str, bytes]
    provenance: Mapping[str, str]
    report: tuple[str, ...]
    folder: Path | RecipeError

    def save(self, folder: Path | str | None = None) -> Path:
        """Write the recipe into a folder, by default its own, and return that."""
        chosen = Path(folder) if folder is not None else self.folder
        if isinstance(chosen, RecipeError):
            raise chosen
        write_recipe(
            chosen,
            self.name,
            self.options,
            self.conventions,
            self.montage,
            self.parent,
            self.conditions,
            self.mappings,
            self.resources,
            self.provenance,
        )
        return chosen
