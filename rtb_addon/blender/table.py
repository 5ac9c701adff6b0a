"""The conditions of a scene with its spectra as files: what was typed becomes what mappings can name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from ..conditions import Condition, Conditions, format_conditions, parse_conditions
from ..errors import RecipeError
from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import shortest
from ..spectra import Spectrum, Unit
from ..spectra.files import spd_text
from ..spectra.spoken import spectrum_from
from .baked import at_condition
from .conditions import IMAGE_NAME
from .own_spectra import own_folders
from .statements import Named, Picture, Spoken, Statement, Varied

_VARIABLE = re.compile(r"\(([^()]+)\)")
_FOLDER = "resources"


class SpectrumFiles:
    """The spectra and pictures of a recipe as files below resources/, each content once under each name."""

    def __init__(self) -> None:
        self.contents: dict[str, bytes] = {}

    def add(self, name: str, spectrum: Spectrum) -> str:
        """Return the path, in the recipe's folder, of a spectrum's file."""
        return self._keep(_stem(name), ".spd", spd_text(spectrum).encode())

    def picture(self, picture: Picture) -> str:
        """Return the path, in the recipe's folder, of a picture's file."""
        file = Path(picture.name)
        return self._keep(_stem(file.stem), file.suffix.lower(), picture.content)

    def _keep(self, stem: str, ending: str, content: bytes) -> str:
        number = 1
        while True:
            file = f"{stem}{f'-{number}' if number > 1 else ''}{ending}"
            twins = [each for each in self.contents if each.casefold() == file.casefold()]
            if not twins or (twins == [file] and self.contents[file] == content):
                self.contents[file] = content
                return f"{_FOLDER}/{file}"
            number += 1


class Table:
    """
    A scene's conditions, growing columns of spectra.

    Parameters
    ----------
    variables : as the scene has them
    names : of the conditions
    rows : cells of each condition, by variable
    spoken : the same as they are typed for spectra
    """

    def __init__(
        self,
        variables: Sequence[str],
        names: Sequence[str],
        rows: Sequence[Mapping[str, str]],
        spoken: Sequence[Mapping[str, str]] = (),
    ) -> None:
        self.variables, self.names = list(variables), list(names)
        self.typed, self._spoken = [dict(row) for row in rows], [dict(row) for row in spoken or rows]
        self.cells = [dict(row) for row in rows]
        self._columns: dict[tuple, str] = {}

    def conditions(self, base: str) -> Conditions:
        """Return the finished table."""
        if not self.names:
            return Conditions.single(base)
        rows = [
            Condition(name, {IMAGE_NAME: name, **cells})
            for name, cells in zip(self.names, self.cells, strict=True)
        ]
        text = format_conditions(Conditions((IMAGE_NAME, *self.variables), tuple(rows)))
        return parse_conditions(text, "the conditions", base)

    def column(self, spoken: Spoken, name: str, only_user: bool, fill: Callable[[str, str], str]) -> str:
        """
        Return the variable that holds the files of a spectrum that conditions vary.

        Parameters
        ----------
        name : of what the spectrum belongs to
        only_user : whether nothing else uses its variables
        fill : returns the file for a text, given what was typed into the cells
        """
        if (known := self._columns.get(spoken.treatment)) is not None:
            return known
        used = _VARIABLE.findall(spoken.text)
        alone = only_user and len(used) == 1 and spoken.text == f"({used[0]})"
        variable = used[0] if alone else self._free(f"{clean(name)}Spectrum")
        if not alone:
            self.variables.append(variable)
        for row in range(len(self.names)):
            said, text = [self._cell(row, each, spoken.owner) for each in used], self.filled_in(row, spoken)
            with at_condition(self.names[row]):
                self.cells[row][variable] = fill(text, "-".join(said))
        self._columns[spoken.treatment] = variable
        return variable

    def varied(self, name: str, cells: Sequence[str]) -> str:
        """Return a new variable, called like a name, with a cell for each condition."""
        variable = self._free(name)
        self.variables.append(variable)
        for row, cell in zip(self.cells, cells, strict=True):
            row[variable] = cell
        return variable

    def filled_in(self, row: int, spoken: Spoken) -> str:
        """Return the text of a spectrum with the cells of a condition in it."""
        return _VARIABLE.sub(lambda found: self._cell(row, found[1], spoken.owner), spoken.text)

    def _cell(self, row: int, variable: str, owner: str) -> str:
        if variable not in self._spoken[row]:
            known = ", ".join(self.variables) or "none"
            raise RecipeError(f"{owner} uses ({variable}), the variables of the conditions are {known}")
        if not self._spoken[row][variable].strip():
            raise RecipeError(
                f"the condition {self.names[row]} says nothing for {variable}, {owner} needs it"
            )
        return self._spoken[row][variable]

    def _free(self, name: str) -> str:
        number, found = 1, name
        while found in self.variables or found == IMAGE_NAME:
            number += 1
            found = f"{name}{number}"
        return found


def mappings_text(
    statements: Iterable[Statement], table: Table, files: SpectrumFiles, folder: Path | None
) -> str:
    """
    Return the mappings that make some statements; their spectra become files, their variables columns.

    Parameters
    ----------
    folder : where spectrum files are that were typed with a relative name
    """
    statements = list(statements)
    users = _treatments_by_variable(statements)
    lines = []
    for each in statements:
        lines.append(f"{each.id}:{each.category}:{each.model}")
        for parameter, spectrum in each.spectra.items():
            value = _value(spectrum, each.name, table, files, folder, users)
            lines.append(f"{each.id}:{parameter}.spectrum = {value}")
        for parameter, number in each.numbers.items():
            value = _number(number, f"{each.name} {parameter}", table)
            lines.append(f"{each.id}:{parameter}.float = {value}")
        for parameter, word in each.words.items():
            kind, value = _word(word, f"{each.name} {parameter}", table, files)
            lines.append(f"{each.id}:{parameter}.{kind} = {value}")
    body = "".join(f"    {line}\n" for line in lines)
    return f"Generic {{\n{body}}}\n" if body else ""


def _number(number: float | Varied, name: str, table: Table) -> str:
    if isinstance(number, Varied):
        cells = [f"{shortest(each):.9g}" for each in number.values]
        return f"({table.varied(clean(name), cells)})"
    return f"{shortest(number):.9g}"


def _word(word: Named | Picture | Varied, name: str, table: Table, files: SpectrumFiles) -> tuple[str, str]:
    """Return the type and the value of a word."""
    if isinstance(word, Picture):
        return "string", files.picture(word)
    if isinstance(word, Varied):
        said = [_word(each, name, table, files) for each in word.values]
        return said[0][0], f"({table.varied(clean(name), [value for _, value in said])})"
    return word.type, word.text


def _varied(spectra: Varied, name: str, table: Table, files: SpectrumFiles, folder: Path | None) -> str:
    """Return the variable for the files of spectra of which each condition has its own."""
    cells = []
    for row, each in enumerate(spectra.values):
        heard = each if isinstance(each, Spectrum) else _heard(each, table.filled_in(row, each), folder)
        cells.append(files.add(name, heard))
    return f"({table.varied(f'{clean(name)}Spectrum', cells)})"


def _value(
    spectrum: Spoken | Spectrum | Varied,
    name: str,
    table: Table,
    files: SpectrumFiles,
    folder: Path | None,
    users: Mapping[str, set[tuple]],
) -> str:
    if isinstance(spectrum, Varied):
        return _varied(spectrum, name, table, files, folder)
    if isinstance(spectrum, Spectrum):
        return files.add(name, spectrum)

    def file_of(text: str, file: str) -> str:
        return files.add(file, _heard(spectrum, text, folder))

    used = _VARIABLE.findall(spectrum.text)
    if not used:
        return file_of(spectrum.text, name)
    if not table.names:
        raise RecipeError(f"{spectrum.owner} uses ({used[0]}), but there are no conditions")
    prefix = "" if spectrum.treatment[1:] == _REFLECTANCE else f"{name}-"
    only = all(users[variable] == {spectrum.treatment} for variable in used)
    return f"({table.column(spectrum, name, only, lambda text, said: file_of(text, prefix + _stem(said)))})"


# What is done to the numbers of a reflectance: nothing.
_REFLECTANCE = Spoken("", "").treatment[1:]


def _heard(spoken: Spoken, text: str, folder: Path | None) -> Spectrum:
    """Return a spectrum that was typed, in the unit that it is for."""
    as_typed = Unit.SHAPE if spoken.is_shape else spoken.unit
    try:
        return spoken.meant(spectrum_from(text, as_typed, folder, own_folders()))
    except (RecipeError, ValueError) as error:
        raise RecipeError(f"{spoken.owner}: {error}") from error


def _treatments_by_variable(statements: Iterable[Statement]) -> dict[str, set[tuple]]:
    found: dict[str, set[tuple]] = {}
    said = [spectrum for each in statements for spectrum in each.spectra.values()]
    for spectrum in [one for each in said for one in (each.values if isinstance(each, Varied) else (each,))]:
        if isinstance(spectrum, Spoken):
            for variable in _VARIABLE.findall(spectrum.text):
                found.setdefault(variable, set()).add(spectrum.treatment)
    return found


def _stem(said: str) -> str:
    """Return what was typed as the name of a file: that of a file without its folder and ending."""
    name = said.strip()
    if name.lower().endswith(".spd"):
        name = re.split(r"[/\\]", name)[-1][:-4]
    return re.sub(r"[^\w.-]+", "-", name).strip("-.") or "spectrum"
