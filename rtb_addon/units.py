"""The units of spectra: apart from them, for what must not wait for numpy."""

from __future__ import annotations

from enum import StrEnum


class Unit(StrEnum):
    """What the numbers of a spectrum are."""

    RATIO = "1"
    SHAPE = "relative"
    POWER = "W nm-1"
    INTENSITY = "W sr-1 nm-1"
    IRRADIANCE = "W m-2 nm-1"
    RADIANCE = "W sr-1 m-2 nm-1"
