"""Spectra in the files that instruments and toolboxes write: pairs, tables, the Psychophysics Toolbox's."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from ..errors import RecipeError
from .bands import FloatArray
from .files import read_spd
from .matlab import read_arrays
from .spectrum import Spectrum

ENDINGS = (".spd", ".csv", ".tsv", ".txt", ".mat")
# What the Psychophysics Toolbox calls arrays that go with S_name: reflectances, lights, sensitivities, bases.
_KINDS = ("sur", "spd", "T", "B", "den", "srf", "trans", "ill")


def read_spectra(path: Path) -> dict[str, Spectrum]:
    """
    Return the spectra in a file by name.

    Parameters
    ----------
    path : ``.spd`` of pairs; ``.csv``, ``.tsv`` or ``.txt`` of columns, wavelength [nm] first; ``.mat`` of
        the Psychophysics Toolbox, whose ``S_name`` says start, step and count [nm] of ``sur_name``
    """
    if path.suffix.lower() == ".mat":
        return _toolbox(path)
    if path.suffix.lower() == ".spd":
        return {path.stem: read_spd(path)}
    return _table(path)


def _table(path: Path) -> dict[str, Spectrum]:
    """Return a spectrum for each column; a first row that is no numbers names them."""
    rows = _rows(path)
    heads = None if rows and _numbers(rows[0]) else (rows.pop(0) if rows else None)
    numbers = []
    for row in rows:
        found = _numbers(row)
        if found is None or len(found) != len(rows[0]) or len(found) < 2:
            line = " ".join(row)
            raise RecipeError(f"'{line}' is no wavelength [nm] with its values", path)
        numbers.append(found)
    if not numbers:
        raise RecipeError("holds no rows of a wavelength [nm] and values", path)
    columns = np.array(numbers, float).T
    names = heads[1:] if heads is not None else []
    if len(columns) == 2:
        names = [path.stem]
    elif len(names) != len(columns) - 1:
        names = _numbered(path.stem, len(columns) - 1)
    return _spectra(names, columns[0], columns[1:], path)


def _rows(path: Path) -> list[list[str]]:
    try:
        text = path.read_text(encoding="utf-8-sig", errors="strict")
    except UnicodeDecodeError:
        text = path.read_text(encoding="latin-1")
    except OSError as error:
        raise RecipeError(f"cannot read {path}: {error.strerror}") from error
    lines = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith(("#", "%"))]
    first = lines[0] if lines else ""
    between = next((each for each in ("\t", ";", ",") if each in first), " ")
    if between == " ":
        return [line.split() for line in lines]
    rows = csv.reader(lines, delimiter=between)
    # Where semicolons stand between numbers, commas stand in them.
    return [[c.strip().replace(",", ".") if between == ";" else c.strip() for c in row] for row in rows]


def _numbers(row: list[str]) -> list[float] | None:
    try:
        return [float(cell) for cell in row if cell]
    except ValueError:
        return None


def _toolbox(path: Path) -> dict[str, Spectrum]:
    arrays = read_arrays(path)
    found: dict[str, Spectrum] = {}
    for name, sampling in arrays.items():
        if not name.startswith("S_") or sampling.size != 3:
            continue
        start, step, count = sampling.ravel()
        wavelengths = start + step * np.arange(int(count))
        for kind in _KINDS:
            values = arrays.get(f"{kind}_{name[2:]}")
            if values is None:
                continue
            # Sensitivities lie along rows, all others down columns.
            rows = values if values.shape[1] == len(wavelengths) and kind == "T" else values.T
            if rows.shape[1] != len(wavelengths):
                raise RecipeError(
                    f"{kind}_{name[2:]} does not fit {name}, {len(wavelengths)} wavelengths", path
                )
            base = f"{kind}_{name[2:]}"
            names = [base] if len(rows) == 1 else _numbered(base, len(rows))
            found.update(_spectra(names, wavelengths, rows, path))
    if not found:
        known = ", ".join(sorted(arrays)) or "no arrays"
        raise RecipeError(f"has no spectra such as sur_name beside S_name, it has {known}", path)
    return found


def _spectra(names: list[str], wavelengths: FloatArray, rows: FloatArray, path: Path) -> dict[str, Spectrum]:
    order = np.argsort(wavelengths)
    try:
        made = [Spectrum.of(wavelengths[order], row[order]) for row in rows]
    except ValueError as error:
        raise RecipeError(str(error), path) from error
    clean = [re.sub(r"[^\w .()+-]+", "-", name).strip(" .-") or "spectrum" for name in names]
    if len({name.casefold() for name in clean}) < len(clean):
        clean = _numbered(path.stem, len(clean))
    return dict(zip(clean, made, strict=True))


def _numbered(name: str, count: int) -> list[str]:
    return [f"{name}-{number:0{len(str(count))}}" for number in range(1, count + 1)]
