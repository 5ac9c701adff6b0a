"""The conditions of a scene as they grow columns: what was typed becomes what mappings can name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence

from ..conditions import Condition, Conditions, format_conditions, parse_conditions
from ..errors import RecipeError
from ..scene.collada.ids import clean
from .conditions import IMAGE_NAME, VARIABLE
from .statements import Spoken
from .table_properties import spoken_cell

_LONG = 60  # what was typed for a spectrum and is longer does not name its file: tables of numbers


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

    def only(self, row: int) -> Table:
        """Return a table of one of its conditions; the same where there is none."""
        rows = slice(row, row + 1)
        return Table(self.variables, self.names[rows], self.cells[rows], self._spoken[rows])

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
        used = VARIABLE.findall(spoken.text)
        alone = only_user and len(used) == 1 and spoken.text == f"({used[0]})"
        variable = used[0] if alone else self._free(f"{clean(name)}Spectrum")
        if not alone:
            self.variables.append(variable)
        for row in range(len(self.names)):
            said, text = [self._cell(row, each, spoken.owner) for each in used], self.filled_in(row, spoken)
            called = "-".join(said)
            try:
                self.cells[row][variable] = fill(text, called if len(called) <= _LONG else self.names[row])
            except RecipeError as error:
                raise RecipeError(f"the condition {self.names[row]}: {error}") from error
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
        return VARIABLE.sub(lambda found: self._cell(row, found[1], spoken.owner), spoken.text)

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


def table_of(scene, name: str) -> Table:
    """Return the scene's conditions."""
    settings = scene.rtb
    variables = [each.name for each in settings.variables]
    if twins := [each for each, count in Counter(variables).items() if count > 1 or not each.strip()]:
        raise RecipeError(f"the variable '{twins[0]}' needs a name that no other one has")
    names, rows = [], []
    for number, condition in enumerate(settings.conditions, 1):
        names.append(condition.name.strip() or f"{name}-{number:03}")
        cells = [each.value for each in condition.cells]
        if len(cells) != len(variables):
            raise RecipeError(
                f"the condition {names[-1]} has {len(cells)} cells for {len(variables)} variables"
            )
        rows.append(dict(zip(variables, cells, strict=True)))
    kinds = {each.name: each for each in settings.variables}
    spoken = [{name: spoken_cell(kinds[name], cell) for name, cell in row.items()} for row in rows]
    return Table(variables, names, rows, spoken)
