"""Spectra as a person writes them into a table: ``300:0.2 500:0.5 800:0.5``, or just ``0.5``."""

from __future__ import annotations

from .spectrum import Spectrum, Unit


def parse_spectrum(text: str, unit: Unit = Unit.RATIO) -> Spectrum:
    """
    Return the spectrum that a text of wavelength:value pairs stands for.

    Parameters
    ----------
    text : pairs [nm]:[unit] separated by blanks; a single pair or a single number is a constant
    unit : of the values

    Raises
    ------
    ValueError : with one sentence, when the text is no spectrum
    """
    words = text.split()
    if not words:
        raise ValueError("an empty text is no spectrum, write pairs like 300:0.5 800:0.75 or one number")
    if len(words) == 1 and ":" not in text:
        return Spectrum.constant(_number(text), unit)
    pairs = [_pair(word) for word in words]
    return Spectrum.of([w for w, _ in pairs], [v for _, v in pairs], unit)


def format_spectrum(spectrum: Spectrum) -> str:
    """Return the pairs that parse_spectrum() reads back as the very same numbers."""
    samples = zip(spectrum.wavelengths, spectrum.values, strict=True)
    return " ".join(f"{format_number(w)}:{format_number(v)}" for w, v in samples)


def format_number(number: float) -> str:
    """Return the shortest text that reads back as the same number."""
    return repr(float(number)).removesuffix(".0")


def _pair(word: str) -> tuple[float, float]:
    wavelength, colon, value = word.partition(":")
    if not colon:
        raise ValueError(f"'{word}' is no wavelength:value pair, write pairs like 300:0.5 800:0.75")
    return _number(wavelength, word), _number(value, word)


def _number(text: str, whole: str = "") -> float:
    try:
        return float(text)
    except ValueError:
        place = f" in '{whole}'" if whole else ""
        raise ValueError(
            f"'{text.strip()}'{place} is no number, write a spectrum as 300:0.5 800:0.75"
        ) from None
