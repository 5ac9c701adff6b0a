"""
Pictures on surfaces: files of colours, or of spectra, as reflectances that vary from place to place.

A texel holds a reflectance at a few wavelengths, with straight lines between them: the channels of a
multispectral file, or the four at which the spectrum of a colour bends (spectra/promotion.py), which is
linear in the colour, so that texels may be mixed before or after.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast
from weakref import WeakValueDictionary

import numpy as np

from ..errors import RecipeError
from ..exr import read_exr
from ..spectra import BandKind, Bands, FloatArray, Spectrum
from ..spectra.channels import bands_of_channels
from ..spectra.promotion import EDGES

# Reflectances of the spectral layout for OpenEXR are T.400,000000nm, radiances S0.400,000000nm.
_REFLECTANCE = re.compile(r"^T\.")
_SRGB_END = 0.04045
# The channel of a colour that a texel holds at each wavelength.
_COLOURS = (2, 1, 1, 0)
# Pictures that are in use somewhere: a big one takes seconds to read.
_in_use: WeakValueDictionary[tuple, Picture] = WeakValueDictionary()


@dataclass(frozen=True, eq=False)
class Picture:
    """
    A picture of reflectances.

    Parameters
    ----------
    texels : (height, width, channels) float32 array, row 0 on top
    wavelengths : (channels,) array [nm]
    measured : whether channels are those of a multispectral file, not made of a colour
    """

    texels: FloatArray
    wavelengths: FloatArray
    measured: bool

    def weights(self, bands: Bands, kind: BandKind) -> FloatArray:
        """
        Return the (channels, bands) array that turns a texel into its value in each band.

        A band about the wavelength of a measured channel has that channel's number, as it is.
        """
        each = np.eye(len(self.wavelengths))
        found = np.stack([Spectrum(self.wavelengths, one).in_bands(bands, kind) for one in each])
        if self.measured:
            for band, centre in enumerate(bands.centres):
                own = np.abs(self.wavelengths - centre) < 1e-6
                if own.any():
                    found[:, band] = own
        return found


def read_picture(path: Path, gamma: float = 1.0) -> Picture:
    """
    Read a picture that Pillow knows, or an OpenEXR file of colours or of spectra.

    Parameters
    ----------
    gamma : stored numbers are raised to it: 1 takes them as they are, -1 undoes the curve of sRGB
    """
    status = path.stat() if path.is_file() else None
    key = path, gamma, status and (status.st_size, status.st_mtime_ns)
    if (known := _in_use.get(key)) is not None:
        return known
    found = _read(path, gamma)
    _in_use[key] = picture = found if isinstance(found, Picture) else _coloured(found)
    return picture


def read_relief(path: Path, gamma: float = 1.0) -> FloatArray:
    """
    Read a picture of heights or of normals: the (height, width, channels) numbers as they are, 3 of colours.

    Heights are the means of the channels; normals have three, each the double of a number less one.
    """
    found = _read(path, gamma)
    return found.texels if isinstance(found, Picture) else found


def sky_gamma(path: Path) -> float:
    """Return the gamma of a picture of the sky: files for screens hold sRGB's curve, others light itself."""
    return 1.0 if path.suffix.lower() == ".exr" else -1.0


def _read(path: Path, gamma: float) -> Picture | FloatArray:
    if path.suffix.lower() != ".exr":
        return _linear(_read_common(path), gamma)
    found = _read_exr(path)
    return _linear(found, gamma) if isinstance(found, np.ndarray) else found


def _read_exr(path: Path) -> Picture | FloatArray:
    planes = {_REFLECTANCE.sub("S0.", name): plane for name, plane in read_exr(path)[1].items()}
    if {"R", "G", "B"} <= planes.keys():
        return np.stack([planes[name] for name in "RGB"], axis=2).astype(np.float32)
    if set(planes) - {"A"} == {"Y"}:
        return np.stack([planes["Y"]] * 3, axis=2).astype(np.float32)
    try:
        names, bands = bands_of_channels(planes)
        texels = np.stack([planes[name] for name in names], axis=2).astype(np.float32)
    except ValueError as error:
        raise RecipeError(f"neither a picture of colours nor one of spectra: {error}", path) from error
    return Picture(_checked(texels, path), bands.centres, measured=True)


def _read_common(path: Path) -> FloatArray:
    """Return (height, width, 3) numbers from 0 to 1, as they are stored."""
    from PIL import Image

    try:
        with Image.open(path) as image:
            if image.mode.startswith("I"):  # sixteen bits of grey
                grey = np.asarray(cast("Any", image), float) / 65535
                return np.stack([grey] * 3, axis=2)
            return np.asarray(cast("Any", image.convert("RGB")), float) / 255
    except OSError as error:
        raise RecipeError("not a picture that can be read, give a PNG, JPEG, TIFF or EXR", path) from error


def _linear(colours: FloatArray, gamma: float) -> FloatArray:
    if gamma == -1:
        steep = ((np.maximum(colours, 0) + 0.055) / 1.055) ** 2.4
        return np.where(colours <= _SRGB_END, colours / 12.92, steep)
    return colours if gamma == 1 else np.maximum(colours, 0) ** gamma


def _coloured(colours: FloatArray) -> Picture:
    texels = np.empty((*colours.shape[:2], len(EDGES)), np.float32)
    for place, channel in enumerate(_COLOURS):
        np.maximum(colours[:, :, channel], 0, out=texels[:, :, place], casting="same_kind")
    return Picture(texels, np.array(EDGES), measured=False)


def _checked(texels: FloatArray, path: Path) -> FloatArray:
    if not (np.isfinite(texels).all() and texels.min() >= 0):
        raise RecipeError("it holds numbers below 0 or none at all, a reflectance is 0 or more", path)
    return texels
