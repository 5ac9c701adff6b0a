"""SpectralImage: a radiance cube and its files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .spectra import BandKind, Bands, FloatArray

UNIT = "W sr-1 m-2 nm-1"


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
    """

    radiance: FloatArray
    bands: Bands
    band_kind: BandKind = "averaged"
    factor: float = 1.0
    attributes: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.radiance.ndim != 3 or self.radiance.shape[2] != len(self.bands):
            raise ValueError(
                f"radiance must be (height, width, {len(self.bands)}), got {self.radiance.shape}"
            )
