"""A spectrum as a person says it: ``D65``, ``daylight 5000``, ``300:0.2 800:0.6``, ``paint.spd``."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

from ..errors import RecipeError
from .files import read_spd
from .library import find, served
from .sources import blackbody, daylight
from .spectrum import Spectrum, Unit
from .text import parse_spectrum

_SOURCES: dict[str, Callable[[float], Spectrum]] = {"daylight": daylight, "blackbody": blackbody}
_SOURCE = re.compile(r"(daylight|blackbody)\s+(\S+?)\s*k?", re.IGNORECASE)
_STARTS_AS_NUMBER = re.compile(r"[-+]?\.?\d\S*(\s|$)")


def spectrum_from(
    text: str, unit: Unit = Unit.RATIO, folder: Path | None = None, own: Iterable[Path] = ()
) -> Spectrum:
    """
    Return the spectrum that a person means.

    Parameters
    ----------
    text : a ``.spd`` file, ``daylight KELVIN``, ``blackbody KELVIN``, wavelength:value pairs, one number,
        or a name of the library
    unit : what the values are to be taken as
    folder : where a relative file is looked for; the working folder if None
    own : folders of somebody's own spectra, which the library then has as well

    Notes
    -----
    A file that is not there is served from the library when it came with RenderToolbox3 (``D65.spd``).
    """
    spoken = text.strip()
    try:
        return replace(_meant(spoken, unit, folder or Path(), own), unit=unit)
    except ValueError as error:
        raise RecipeError(f"'{spoken}': {error}" if spoken else str(error)) from error


def _meant(text: str, unit: Unit, folder: Path, own: Iterable[Path]) -> Spectrum:
    if text.lower().endswith(".spd"):
        return _from_file(text, unit, folder)
    if source := _SOURCE.fullmatch(text):
        return _SOURCES[source.group(1).lower()](_kelvin(source.group(2)))
    if not text or ":" in text or _STARTS_AS_NUMBER.match(text):
        return parse_spectrum(text, unit)
    return find(text, own)


def _from_file(name: str, unit: Unit, folder: Path) -> Spectrum:
    path = folder / name
    if path.is_file():
        return read_spd(path, unit)
    if (spectrum := served(name)) is not None:
        return spectrum
    raise RecipeError(f"there is no spectrum file {name} in {folder.resolve()}")


def _kelvin(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"'{text}' is no temperature, write it in kelvin like daylight 5000") from None
