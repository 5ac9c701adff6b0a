"""Blender's images as files of a recipe."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..errors import RecipeError
from .statements import Picture

# How an image's values are coded: those of Blender's colour spaces that pictures for screens have.
_CODED = {"sRGB": 2.2, "sRGB OETF": 2.2}


def picture_of(image, owner: str) -> Picture:
    """
    Return an image's file, packed or on disk.

    Parameters
    ----------
    owner : what shows it, for messages
    """
    if image.packed_file is not None:
        name = bpy.path.basename(image.filepath) or f"{image.name}.{image.file_format.lower()}"
        return Picture(name, bytes(image.packed_file.data))
    if image.source != "FILE" or image.is_dirty or not image.filepath:
        raise RecipeError(f"{owner} shows the image {image.name}, which is in no file: save or pack it")
    file = Path(bpy.path.abspath(image.filepath, library=image.library))
    try:
        return Picture(file.name, file.read_bytes())
    except OSError as error:
        raise RecipeError(
            f"{owner} shows the image {image.name}, whose file {file} cannot be read: {error.strerror}"
        ) from error


def gamma_of(image) -> float:
    """Return how an image is coded: 2.2 for the sRGB curve, 1 for values as they are."""
    return _CODED.get(image.colorspace_settings.name, 1.0)
