"""Spectrum files (.spd): a wavelength and a value on each line."""

from __future__ import annotations

import re
from pathlib import Path

from ..errors import RecipeError
from ..files import write_text
from .spectrum import Spectrum, Unit

_COMMENT = re.compile(r"[#%].*")


def read_spd(path: Path, unit: Unit = Unit.RATIO) -> Spectrum:
    """
    Return the spectrum in a file.

    Parameters
    ----------
    path : text of numbers, in turn a wavelength [nm] and a value [unit]; ``#`` and ``%`` begin comments
    unit : of the values
    """
    numbers = _numbers(_text(path), path)
    if not numbers or len(numbers) % 2:
        message = f"{len(numbers)} numbers are no pairs, want a wavelength [nm] and a value on each line"
        raise RecipeError(message, path)
    wavelengths = [number for number, _ in numbers[0::2]]
    values = [number for number, _ in numbers[1::2]]
    for (before, _), (after, line) in zip(numbers[0:-2:2], numbers[2::2], strict=True):
        if not after > before:
            raise RecipeError(
                f"{after:g} nm comes after {before:g} nm, wavelengths must increase", path, line
            )
    try:
        return Spectrum.of(wavelengths, values, unit)
    except ValueError as error:
        raise RecipeError(str(error), path) from error


def write_spd(path: Path, spectrum: Spectrum) -> None:
    """Write a spectrum file, whole or not at all."""
    write_text(path, spd_text(spectrum))


def spd_text(spectrum: Spectrum) -> str:
    """Return the text of a spectrum's file; nine digits keep what single precision can tell apart."""
    samples = zip(spectrum.wavelengths, spectrum.values, strict=True)
    return "".join(f"{wavelength:.9g} {value:.9g}\n" for wavelength, value in samples)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise RecipeError("not a text file, want a wavelength [nm] and a value on each line", path) from error
    except OSError as error:
        raise RecipeError(f"cannot read the spectrum file {path}: {error.strerror}") from error


def _numbers(text: str, path: Path) -> list[tuple[float, int]]:
    """Return each number with its line; RenderToolbox3 too reads them as one stream of pairs."""
    found = []
    for line, content in enumerate(text.splitlines(), start=1):
        for word in _COMMENT.sub("", content).split():
            try:
                found.append((float(word), line))
            except ValueError:
                message = f"'{word}' is no number, want a wavelength [nm] and a value on each line"
                raise RecipeError(message, path, line) from None
    return found
