"""
Layers: what a picture knows beside radiance, through the same camera, and their file.

One OpenEXR file holds all layers of a condition, as channels ``LAYER.PART``: ``depth.Z``, ``normal.X``,
``object.id``, ``albedo.S0.400,000000nm``. docs/formats.md lists them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .errors import RecipeError
from .exr import read_exr, write_exr
from .spectra import Bands
from .spectra.channels import bands_of_channels, channel_name
from .spectral_image import UNIT

# Layer -> its parts, as channels call them, and its unit; None: a part for each band.
PARTS: Mapping[str, tuple[tuple[str, ...] | None, str]] = {
    "depth": (("Z",), "m"),
    "normal": (("X", "Y", "Z"), "1"),
    "uv": (("U", "V"), "1"),
    "object": (("id",), "1"),
    "material": (("id",), "1"),
    "albedo": (None, "1"),
    "direct": (None, UNIT),
    "indirect": (None, UNIT),
    "standard_error": (None, UNIT),
}
NAMES = tuple(PARTS)
ERROR = "standard_error"  # comes with a rendering itself, the others from a renderer's layers()
_PREFIX = "rtb."


@dataclass(frozen=True, eq=False)
class Layers:
    """
    Planes of one picture, seen once through the centre of each pixel; row 0 on top.

    Parameters
    ----------
    planes : by layer; where nothing is seen they are 0, and the depth is infinite
        depth : (height, width) array, along the view axis [m]
        normal : (height, width, 3) array, unit shading normals in the world
        uv : (height, width, 2) array
        object, material : (height, width) array of whole numbers, 1 for the first of its names
        albedo : (height, width, bands) array [1]
        direct, indirect, standard_error : (height, width, bands) arrays [W sr-1 m-2 nm-1]
    bands : of the spectral layers [nm]; None where there are none
    names : what the numbers of object and material stand for, in order
    """

    planes: Mapping[str, NDArray]
    bands: Bands | None = None
    names: Mapping[str, Sequence[str]] = field(default_factory=dict)

    def scaled(self, factor: float) -> Layers:
        """Return the layers with every radiance in them multiplied by a factor."""
        planes = {
            name: plane * np.float32(factor) if PARTS[name][1] == UNIT else plane
            for name, plane in self.planes.items()
        }
        return replace(self, planes=planes)

    def save(self, path: Path) -> None:
        """Write an OpenEXR file, whole or not at all; numbers keep their bits as 32-bit ones."""
        header = {f"{_PREFIX}{layer}.names": json.dumps(list(names)) for layer, names in self.names.items()}
        units = {f"{_PREFIX}{layer}.unit": PARTS[layer][1] for layer in self.planes}
        write_exr(path, {**header, **units}, dict(self._channels()))

    @classmethod
    def load(cls, path: Path) -> Layers:
        """Read a file that save() wrote; others raise a RecipeError."""
        header, channels = read_exr(path)
        layers = {name.partition(".")[0] for name in channels}
        if unknown := layers - PARTS.keys():
            raise RecipeError(f"{', '.join(sorted(unknown))} is no layer, want {', '.join(NAMES)}", path)
        found = {layer: _plane(layer, channels, path) for layer in NAMES if layer in layers}
        names = {
            layer: tuple(json.loads(header[word]))
            for layer in ("object", "material")
            if (word := f"{_PREFIX}{layer}.names") in header
        }
        return cls({layer: plane for layer, (plane, _) in found.items()}, _bands_of(found, path), names)

    def _channels(self) -> Iterator[tuple[str, NDArray]]:
        centres = () if self.bands is None else self.bands.centres
        for layer, plane in self.planes.items():
            parts = PARTS[layer][0] or [channel_name(nm) for nm in centres]
            kind = np.uint32 if parts == ("id",) else np.float32
            for part, values in zip(parts, np.moveaxis(np.atleast_3d(plane), 2, 0), strict=True):
                yield f"{layer}.{part}", values.astype(kind)


def _plane(layer: str, channels: Mapping[str, NDArray], path: Path) -> tuple[NDArray, Bands | None]:
    """Return a layer's plane, and its bands where it has some."""
    mine = {name.partition(".")[2]: plane for name, plane in channels.items() if name.startswith(f"{layer}.")}
    parts, bands = PARTS[layer][0], None
    try:
        if parts is None:
            parts, bands = bands_of_channels(mine)
        planes = [mine[part] for part in parts]
    except (KeyError, ValueError) as error:
        raise RecipeError(f"its layer {layer} is not whole, there is no channel for {error}", path) from error
    return (planes[0] if len(planes) == 1 and bands is None else np.stack(planes, axis=2)), bands


def _bands_of(found: Mapping[str, tuple[NDArray, Bands | None]], path: Path) -> Bands | None:
    bands = [each for _, each in found.values() if each is not None]
    if any(not np.array_equal(each.centres, bands[0].centres) for each in bands):
        raise RecipeError("its spectral layers differ in their bands", path)
    return bands[0] if bands else None
