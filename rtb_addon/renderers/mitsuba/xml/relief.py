"""
Bumps and normal maps as Mitsuba's: stock plugins over a picture that stock Mitsuba reads as we do.

Mitsuba would take the luminance of colours for a height, and the upper row of a picture for V = 0. So the
numbers that count are written once, by content, beside the meshes.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np

from ....errors import RecipeError
from ....files import write_bytes
from ....scene.render_scene import Texture
from ....spectra import FloatArray
from ...pictures import read_relief
from .spectrum import element
from .textures import finite, wrap_of


def heights(one: Texture, folder: Path) -> Xml.Element:
    """Return a texture of the means of a picture's channels."""
    return _relief(one, "heights", _numbers(one).mean(axis=2, keepdims=True), folder)


def normals(one: Texture, folder: Path) -> Xml.Element:
    """Return a texture of a picture's three channels."""
    numbers = _numbers(one)
    if numbers.shape[2] != 3:
        raise RecipeError(
            f"the normal map {one.id} has {numbers.shape[2]} channels, give a picture of colours",
            Path(str(one.parameters["filename"])),
        )
    return _relief(one, "normalmap", numbers, folder)


def _numbers(one: Texture) -> FloatArray:
    if one.kind != "bitmap":
        raise RecipeError(f"{one.id} is a {one.kind}, whose edges have no slope, give bumps a bitmap")
    return read_relief(Path(str(one.parameters["filename"])), finite(one, "gamma")).astype(np.float32)


def _relief(one: Texture, name: str, numbers: FloatArray, folder: Path) -> Xml.Element:
    file = _written(numbers, folder)
    node = element(
        "texture",
        "bitmap",
        name=name,
        filename=Path(os.path.relpath(file, folder)).as_posix(),
        raw=True,
        wrap_mode=wrap_of(one),
        filter_type="bilinear",
    )
    # V grows upwards, Mitsuba's rows downwards.
    place = Xml.SubElement(node, "transform", name="to_uv")
    Xml.SubElement(place, "scale", x=repr(finite(one, "scaleU")), y=repr(-finite(one, "scaleV")), z="1.0")
    Xml.SubElement(place, "translate", x=repr(finite(one, "offsetU")), y=repr(1 - finite(one, "offsetV")))
    return node


def _written(numbers: FloatArray, folder: Path) -> Path:
    """
    Write numbers once, as a PFM, and return their file.

    Mitsuba 3.9 waits for ever when it reads an OpenEXR file with one thread.
    """
    content = hashlib.sha256(repr(numbers.shape).encode() + numbers.tobytes()).hexdigest()[:20]
    path = folder / "meshes" / f"{content}.pfm"
    if not path.exists():
        height, width, channels = numbers.shape
        header = f"{'Pf' if channels == 1 else 'PF'}\n{width} {height}\n-1.0\n"
        # From the lowest row upwards, little-endian.
        write_bytes(path, header.encode() + numbers[::-1].astype("<f4").tobytes())
    return path
