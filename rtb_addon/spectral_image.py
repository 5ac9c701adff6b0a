"""
SpectralImage: a radiance cube and its files.

A cube is a float32 OpenEXR in the layout of Fichet, Pacanowski and Wilkie 2021 (JCGT 10(3)): a channel
``S0.400,000000nm`` for each band. What that layout has no word for stands in text attributes whose
names begin with ``rtb.``, docs/formats.md lists them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import get_args

import numpy as np

from .errors import RecipeError
from .exr import read_exr, write_exr
from .spectra import BandKind, Bands, FloatArray
from .spectra.channels import bands_of_channels, channel_name
from .spectra.text import format_number

UNIT = "W sr-1 m-2 nm-1"

_PREFIX = "rtb."
# What the layout asks for. Its word for units leaves the nanometre to the channels' names.
_LAYOUT = {
    "spectralLayoutVersion": "1.0",
    "emissiveUnits": "W.m^-2.sr^-1",
    "polarisationHandedness": "right",
}
_OURS = ("unit", "band_kind", "band_centres", "band_edges", "factor")


@dataclass(frozen=True, eq=False)
class SpectralImage:
    """
    An image whose every pixel is a spectrum.

    Parameters
    ----------
    radiance : (height, width, bands) float32 array [W sr-1 m-2 nm-1], row 0 on top
    bands : wavelength bands [nm]
    band_kind : what a band's number stands for
    factor : what the renderer's raw numbers were multiplied by to become radiance
    attributes : what else is written in the file: conventions, condition, renderer, key ...
    standard_error : of each radiance, the same shape and unit, where a renderer was asked for it; a cube's
        file does not hold it, the layers beside it do
    """

    radiance: FloatArray
    bands: Bands
    band_kind: BandKind = "averaged"
    factor: float = 1.0
    attributes: Mapping[str, str] = field(default_factory=dict)
    standard_error: FloatArray | None = None

    def __post_init__(self) -> None:
        if self.radiance.ndim != 3 or self.radiance.shape[2] != len(self.bands):
            raise ValueError(
                f"radiance must be (height, width, {len(self.bands)}), got {self.radiance.shape}"
            )

    def scaled(self, factor: float) -> SpectralImage:
        """Return the image with every radiance, and the recorded factor, multiplied by a factor."""
        if factor == 1:
            return self
        error = self.standard_error
        return replace(
            self,
            radiance=self.radiance * np.float32(factor),
            factor=self.factor * factor,
            standard_error=None if error is None else error * np.float32(abs(factor)),
        )

    def with_attributes(self, attributes: Mapping[str, str]) -> SpectralImage:
        """Return the image with more attributes; an old one of the same name gives way."""
        return replace(self, attributes={**self.attributes, **attributes})

    def save(self, path: Path) -> None:
        """Write an OpenEXR file, whole or not at all; bits of radiance stay as they are."""
        planes = np.ascontiguousarray(np.moveaxis(self.radiance, 2, 0), np.float32)
        channels = {channel_name(nm): plane for nm, plane in zip(self.bands.centres, planes, strict=True)}
        if len(channels) != len(self.bands):
            raise RecipeError("bands closer than a millionth of a nanometre cannot be written", path)
        write_exr(path, self._header(), channels)

    @classmethod
    def load(cls, path: Path) -> SpectralImage:
        """
        Read a cube: one of ours, of another program in the same layout, or of RenderToolbox3.

        Raises
        ------
        RecipeError : when the file is missing, truncated, or no cube
        """
        header, channels = read_exr(path)
        try:
            names, bands = bands_of_channels(channels)
        except ValueError as error:
            raise RecipeError(str(error), path) from error
        if len({channels[name].shape for name in names}) != 1:
            raise RecipeError("its channels differ in size, a cube's have one value for every pixel", path)
        radiance = np.stack([channels[name].astype(np.float32, copy=False) for name in names], axis=2)
        return _with_our_words(cls(radiance, bands), _our_words(header), path)

    def _header(self) -> dict[str, str]:
        words = {
            **self.attributes,
            "unit": UNIT,
            "band_kind": self.band_kind,
            "band_centres": " ".join(map(format_number, self.bands.centres)),
            "band_edges": " ".join(map(format_number, self.bands.edges)),
            "factor": format_number(self.factor),
        }
        return {**_LAYOUT, **{_PREFIX + name: str(word) for name, word in words.items()}}


def _our_words(header: Mapping[str, object]) -> dict[str, str]:
    ours = {name.removeprefix(_PREFIX): word for name, word in header.items() if name.startswith(_PREFIX)}
    return {name: word for name, word in ours.items() if isinstance(word, str)}


def _with_our_words(image: SpectralImage, words: dict[str, str], path: Path) -> SpectralImage:
    """Return the image with what our attributes add to the names of its channels."""
    if "unit" not in words:
        return image
    if words["unit"] != UNIT:
        raise RecipeError(f"its numbers are {words['unit']}, a rendering's are {UNIT}", path)
    try:
        centres, edges = (np.array(words[name].split(), float) for name in ("band_centres", "band_edges"))
        bands, factor, kind = Bands(centres, edges), float(words["factor"]), _band_kind(words["band_kind"])
    except (KeyError, ValueError) as error:
        raise RecipeError(f"its rtb attributes are not those of a rendering: {error}", path) from error
    if (
        bands.centres.shape != image.bands.centres.shape
        or abs(bands.centres - image.bands.centres).max() > 1e-6
    ):
        raise RecipeError("its attribute rtb.band_centres differs from its channels", path)
    others = {name: word for name, word in words.items() if name not in _OURS}
    return replace(image, bands=bands, band_kind=kind, factor=factor, attributes=others)


def _band_kind(word: str) -> BandKind:
    if word not in get_args(BandKind):
        raise ValueError(f"'{word}' is none of the band kinds {', '.join(get_args(BandKind))}")
    return word  # type: ignore[return-value]
