"""A rendering takes its place in the recipe's folder: whole with its record, or not at all."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..conditions import Condition
from ..errors import RecipeError
from ..files import temporary_prefix
from ..layers import Layers
from ..recipe import Recipe
from ..spectral_image import SpectralImage
from . import records

SCRATCH = ".unfinished"  # where cubes are written before they take their place


@dataclass(frozen=True)
class Rendering:
    """
    A condition's radiance cube on disk.

    Parameters
    ----------
    condition : its name
    file : the cube, float32 OpenEXR [W sr-1 m-2 nm-1]
    record : how it was made
    new : whether it was rendered now, rather than found done
    """

    condition: str
    file: Path
    record: Mapping[str, Any]
    new: bool

    @property
    def image(self) -> SpectralImage:
        """The cube's content."""
        return SpectralImage.load(self.file)


@dataclass(frozen=True)
class Unsaved:
    """
    What was rendered of a condition; it knows no recipe, so that any thread can save it.

    Parameters
    ----------
    image, layers : in SI units
    record : how it was made
    factor : from SI units to the recipe's
    folder : of the recipe
    file, record_file, layers_file : where they go
    """

    condition: str
    image: SpectralImage
    layers: Layers | None
    record: dict[str, Any]
    factor: float
    folder: Path
    file: Path
    record_file: Path
    layers_file: Path

    @classmethod
    def of(
        cls,
        recipe: Recipe,
        condition: Condition,
        image: SpectralImage,
        layers: Layers | None,
        record: dict[str, Any],
    ) -> Unsaved:
        """Return what was rendered of a recipe's condition."""
        places = (
            recipe.rendering_file(condition),
            recipe.record_file(condition),
            recipe.layers_file(condition),
        )
        return cls(condition.name, image, layers, record, recipe.conventions.factor, recipe.folder, *places)

    def save(self) -> Rendering:
        """
        Put the cube, its record and its layers into the folder, in the recipe's units.

        The cube is written outside renderings/ and moved in, the others go first: whatever moment a
        process is killed in, a cube is there whole with its record, or it is not there.
        """
        image = self.image.scaled(self.factor)
        record = {**self.record, "factor": image.factor, "renderer says": dict(image.attributes)}
        scratch = _scratch_folder(self.folder, self.file.parent)
        aside = scratch / (temporary_prefix(os.getpid()) + self.file.name)
        try:
            image.with_attributes(records.attributes(record)).save(aside)
            if self.layers is not None:
                self.layers.scaled(self.factor).save(self.layers_file)
            records.write(self.record_file, record)
            aside.replace(self.file)
        except OSError as error:
            raise RecipeError(f"cannot write {self.file}: {error.strerror}") from error
        finally:
            aside.unlink(missing_ok=True)
        return Rendering(self.condition, self.file, record, True)


def _scratch_folder(recipe: Path, target: Path) -> Path:
    """Return a folder of unfinished cubes on the disk of the finished ones."""
    target.mkdir(parents=True, exist_ok=True)
    same_disk = target.stat().st_dev == recipe.stat().st_dev
    folder = (recipe if same_disk else target) / SCRATCH
    folder.mkdir(exist_ok=True)
    return folder
