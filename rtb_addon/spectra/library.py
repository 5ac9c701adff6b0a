"""
Measured and standard spectra by name, out of the small tables in data/.

The tables come from colour-science (packaging/make_library.py writes them), which Blender's own
process must not import, and from the refractiveindex.info database (packaging/make_indices.py).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from functools import cache
from pathlib import Path

import numpy as np

from ..errors import RecipeError
from .files import read_spd
from .spectrum import Spectrum, Unit

_DATA = Path(__file__).parents[1] / "data"
_TABLES = {"illuminants.csv": Unit.SHAPE, "lamps.csv": Unit.SHAPE, "color_checkers.csv": Unit.RATIO}
_INDICES = "indices.csv"
_OLD_METAL = re.compile(r"(\w+)\.(eta|k)\.spd")
_OLD_PATCH = re.compile(r"mccbabel-(\d+)\.spd")
_ROWS, _COLUMNS = 4, 6
_OFFERED = 3  # names at most, where there is none as asked for

CHART = "BabelColor Average"
OWN = "Own/"


def names(folders: Iterable[Path] = ()) -> list[str]:
    """
    Return every spectrum's name: lights, each checker's patches in the chart's order, indices, own ones.

    Metals have two, ``Metals/Cu copper eta`` and ``Metals/Cu copper k``; glasses one, ``Glasses/N-BK7``.

    Parameters
    ----------
    folders : of somebody's own ``.spd`` files, which are called ``Own/`` and their path in there
    """
    return [*_all(), *own_files(folders)]


def own_files(folders: Iterable[Path]) -> dict[str, Path]:
    """Return somebody's own files by their names in the library; of two with one name, the first counts."""
    found: dict[str, Path] = {}
    for folder in folders:
        for file in sorted(folder.rglob("*.spd")):
            found.setdefault(OWN + file.relative_to(folder).with_suffix("").as_posix(), file)
    return found


def is_light(name: str) -> bool:
    """Return whether a spectrum of the library, no own one, is a light's and no surface's."""
    return _all()[name].unit is Unit.SHAPE


def metals() -> list[str]:
    """Return the names of the metals, to which `` eta`` and `` k`` are added: ``Metals/Cu copper``."""
    return [name.removesuffix(" eta") for name in _all() if name.endswith(" eta")]


def find(name: str, folders: Iterable[Path] = ()) -> Spectrum:
    """
    Return a spectrum by its name, in any case of letters.

    Illuminants (``D65``) and lamps (``NIST Lamps/HPS``) are relative, as tabulated; patches
    (``BabelColor Average/blue``) are reflectances; of metals and glasses there are indices of refraction,
    and of metals those of extinction.
    """
    key = name.strip().lower()
    own = own_files(folders) if key.startswith(OWN.lower()) else {}
    known = {each.lower(): each for each in (*_all(), *own)}
    if key in known:
        return read_spd(own[known[key]]) if known[key] in own else _all()[known[key]]
    near = [known[each] for each in known if key and key in each][:_OFFERED]
    near = near or [known[each] for each in get_close_matches(key, known, n=_OFFERED, cutoff=0.5)]
    remedy = f"did you mean {', '.join(near)}" if near else "its names are those of colour-science, like D65"
    raise RecipeError(f"no spectrum of the library is called '{name.strip()}', {remedy}")


def patches(chart: str = CHART) -> list[str]:
    """Return the names of a checker's 24 spectra, row by row as the chart hangs: 4 rows of 6."""
    return [name for name in _all() if name.rpartition("/")[0] == chart]


def served(filename: str) -> Spectrum | None:
    """Return what the library serves for a file that came with RenderToolbox3, or None."""
    base = re.split(r"[/\\]", filename)[-1].lower()
    if base == "d65.spd":
        return find("D65")
    if base == "dimflat.spd":
        return Spectrum.of([380, 780], [1, 1], Unit.SHAPE)
    if metal := _OLD_METAL.fullmatch(base):
        return _metal(*metal.groups())
    number = int(old.group(1)) if (old := _OLD_PATCH.fullmatch(base)) else 0
    if not 1 <= number <= _ROWS * _COLUMNS:
        return None
    column, row = divmod(number - 1, _ROWS)  # RenderToolbox3 numbers down the columns
    return _all()[patches()[row * _COLUMNS + column]]


@cache
def _all() -> Mapping[str, Spectrum]:
    regular = {name: spectrum for table, unit in _TABLES.items() for name, spectrum in _read(table, unit)}
    return {**regular, **dict(_read_indices())}


def _metal(symbol: str, part: str) -> Spectrum | None:
    known = (name for name in _all() if re.fullmatch(rf"Metals/{symbol} \w+ {part}", name, re.IGNORECASE))
    return next((_all()[name] for name in known), None)


def _read(table: str, unit: Unit):
    """Yield a table's spectra; each line is a name, the first wavelength [nm], the step [nm], the values."""
    for line in (_DATA / table).read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            name, start, step, *values = line.split(",")
            wavelengths = float(start) + float(step) * np.arange(len(values))
            yield name, Spectrum(wavelengths, np.array(values, float), unit)


def _read_indices():
    """Yield the indices, as they were measured; each line is a name and pairs of wavelength [nm]:value."""
    for line in (_DATA / _INDICES).read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            name, *pairs = line.split(",")
            samples = np.array([pair.split(":") for pair in pairs], float).T
            yield name, Spectrum(samples[0], samples[1], Unit.RATIO)
