"""What a recipe writes as the value of a parameter: spectra, files, numbers, colours, names."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..errors import at
from ..spectra import Spectrum, Unit
from ..spectra.files import read_spd
from ..spectra.library import served
from ..spectra.promotion import promoted
from ..spectra.text import parse_spectrum
from .adjustments import Property
from .paths import numbers_in
from .render_scene import TextureUse, Value
from .vocabulary import Parameter

FindFile = Callable[[str], Path | None]

_FILE_NAME = re.compile(r"\.[A-Za-z]\w*$")
# Ratios that are no reflectances: indices of refraction and extinction may well be above 1.
_INDICES = ("eta", "k", "intIOR")


@dataclass
class Values:
    """
    Reads values, looking files up.

    Parameters
    ----------
    find_file : returns the recipe's file of a name, or None
    warnings : sentences about what is odd
    """

    find_file: FindFile
    warnings: list[str] = field(default_factory=list)

    def read(self, owner: str, parameter: Parameter, said: Property) -> Value:
        """Return what a property says, as its parameter wants it; owner is the id of what it belongs to."""
        with at(said.file, said.line):
            if said.type == "texture":
                return TextureUse(said.value)
            if parameter.kind == "spectrum":
                return self._spectrum(owner, said, Unit(parameter.unit))
            if parameter.kind == "index" and said.type == "spectrum":
                return self._spectrum(owner, said, Unit(parameter.unit))
            if parameter.kind in ("number", "index"):
                return _number(said)
            if parameter.choices and said.value not in parameter.choices:
                there = ", ".join(parameter.choices)
                raise ValueError(f"{said.name} of {owner} is {said.value}, want one of {there}")
            return self._file(said) if said.name == "filename" else said.value

    def _spectrum(self, owner: str, said: Property, unit: Unit) -> Spectrum:
        if said.type == "rgb":
            return self._colour(owner, said, unit)
        spectrum = self._written(said, unit)
        place = f"{said.name} of {owner}"
        if spectrum.values.min() < 0:
            self.warnings.append(f"{place} is below 0 at some wavelengths")
        if unit is Unit.RATIO and said.name not in _INDICES and spectrum.values.max() > 1:
            self.warnings.append(f"{place} reaches {spectrum.values.max():.4g}, more than all light")
        return spectrum

    def _written(self, said: Property, unit: Unit) -> Spectrum:
        try:
            return parse_spectrum(said.value, unit)
        except ValueError:
            if not _FILE_NAME.search(said.value):
                raise
        if (file := said.found or self.find_file(said.value)) is not None:
            return read_spd(file, unit)
        if (known := served(said.value)) is not None:
            self.warnings.append(f"{said.value} is not in the recipe's folder, the library's own stands in")
            return replace(known, unit=unit)
        raise ValueError(
            f"there is no spectrum file {said.value} in the recipe's folder or its resources/, and the"
            " library serves none of that name"
        )

    def _colour(self, owner: str, said: Property, unit: Unit) -> Spectrum:
        colour = numbers_in(said.value)
        if len(colour) != 3:
            raise ValueError(f"{said.name} is '{said.value}', want red, green and blue")
        self.warnings.append(f"{said.name} of {owner} is a colour and was promoted to a spectrum")
        return promoted(colour, unit)

    def _file(self, said: Property) -> str:
        if (file := said.found or self.find_file(said.value)) is None:
            raise ValueError(f"there is no file {said.value} in the recipe's folder or its resources/")
        return str(file)


def _number(said: Property) -> float:
    found = numbers_in(said.value)
    if len(found) != 1:
        raise ValueError(f"{said.name} is '{said.value}', want one number")
    return found[0]
