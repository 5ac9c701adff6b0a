"""What is stated of materials and lights as mappings; their spectra become files, their variables columns."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

from ..errors import RecipeError
from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import shortest
from ..spectra import Spectrum, Unit
from .conditions import VARIABLE
from .spectrum_files import SpectrumFiles, stem_of
from .statements import Named, Picture, Spoken, Statement, Varied
from .table import Table

# What is done to the numbers of a reflectance: nothing.
_REFLECTANCE = Spoken("", "").treatment[1:]

Hear = Callable[[str, Unit], Spectrum]


def mappings_text(statements: Iterable[Statement], table: Table, files: SpectrumFiles, hear: Hear) -> str:
    """
    Return the mappings that make some statements.

    Parameters
    ----------
    hear : returns the spectrum that a text means, in a unit
    """
    statements = list(statements)
    writer = _Writer(table, files, hear, _treatments_by_variable(statements))
    body = "".join(f"    {line}\n" for each in statements for line in writer.lines(each))
    return f"Generic {{\n{body}}}\n" if body else ""


@dataclass(frozen=True)
class _Writer:
    """
    Writes statements for a table.

    Parameters
    ----------
    users : for each variable what is done to the numbers of its spectra
    """

    table: Table
    files: SpectrumFiles
    hear: Hear
    users: Mapping[str, set[tuple]]

    def lines(self, said: Statement) -> Iterable[str]:
        """Yield the lines that make a statement."""
        yield f"{said.id}:{said.category}:{said.model}"
        for parameter, spectrum in said.spectra.items():
            yield f"{said.id}:{parameter}.spectrum = {self._spectrum(spectrum, said.name)}"
        for parameter, number in said.numbers.items():
            yield f"{said.id}:{parameter}.float = {self._number(number, f'{said.name} {parameter}')}"
        for parameter, word in said.words.items():
            kind, value = self._word(word, f"{said.name} {parameter}")
            yield f"{said.id}:{parameter}.{kind} = {value}"

    def _number(self, number: float | Varied, name: str) -> str:
        if isinstance(number, Varied):
            cells = [f"{shortest(each):.9g}" for each in number.values]
            return f"({self.table.varied(clean(name), cells)})"
        return f"{shortest(number):.9g}"

    def _word(self, word: Named | Picture | Varied, name: str) -> tuple[str, str]:
        """Return the type and the value of a word."""
        if isinstance(word, Picture):
            return "string", self.files.picture(word)
        if isinstance(word, Varied):
            said = [self._word(each, name) for each in word.values]
            return said[0][0], f"({self.table.varied(clean(name), [value for _, value in said])})"
        return word.type, word.text

    def _spectrum(self, spectrum: Spoken | Spectrum | Varied, name: str) -> str:
        if isinstance(spectrum, Varied):
            return self._varied(spectrum, name)
        if isinstance(spectrum, Spectrum):
            return self.files.add(name, spectrum)
        used = VARIABLE.findall(spectrum.text)
        if not used:
            return self.files.add(name, self._heard(spectrum, spectrum.text))
        if not self.table.names:
            raise RecipeError(f"{spectrum.owner} uses ({used[0]}), but there are no conditions")
        prefix = "" if spectrum.treatment[1:] == _REFLECTANCE else f"{name}-"
        only = all(self.users[variable] == {spectrum.treatment} for variable in used)

        def fill(text: str, said: str) -> str:
            return self.files.add(prefix + stem_of(said), self._heard(spectrum, text))

        return f"({self.table.column(spectrum, name, only, fill)})"

    def _varied(self, spectra: Varied, name: str) -> str:
        """Return the variable for the files of spectra of which each condition has its own."""
        cells = []
        for row, each in enumerate(spectra.values):
            spoken = isinstance(each, Spoken)
            heard = self._heard(each, self.table.filled_in(row, each)) if spoken else each
            cells.append(self.files.add(name, heard))
        return f"({self.table.varied(f'{clean(name)}Spectrum', cells)})"

    def _heard(self, spoken: Spoken, text: str) -> Spectrum:
        """Return a spectrum that was typed, in the unit that it is for."""
        try:
            return spoken.meant(self.hear(text, Unit.SHAPE if spoken.is_shape else spoken.unit))
        except (RecipeError, ValueError) as error:
            raise RecipeError(f"{spoken.owner}: {error}") from error


def _treatments_by_variable(statements: Iterable[Statement]) -> dict[str, set[tuple]]:
    found: dict[str, set[tuple]] = {}
    said = [spectrum for each in statements for spectrum in each.spectra.values()]
    for spectrum in [one for each in said for one in (each.values if isinstance(each, Varied) else (each,))]:
        if isinstance(spectrum, Spoken):
            for variable in VARIABLE.findall(spectrum.text):
                found.setdefault(variable, set()).add(spectrum.treatment)
    return found
