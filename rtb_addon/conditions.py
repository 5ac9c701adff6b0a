"""The table of conditions: one row, one scene."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from .errors import RecipeError, choices
from .scene.adjustments import Remark

NAME = "imageName"
# Spaces belong to a cell and nothing is quoted; commas count only right after a tab, as they always did.
_CELL = re.compile(r"([^\t\n\r\v\f]+)[\t,]*")
_UNSAFE = re.compile(r'[\x00-\x1f\x7f<>:"/\\|?*]|^[.\s]|[.\s]$')
_RESERVED = re.compile(r"(?:con|prn|aux|nul|com\d|lpt\d)(?:\..*)?", re.I)
_LONGEST = 200


@dataclass(frozen=True)
class Condition:
    """
    One row of the table.

    Parameters
    ----------
    name : names the condition's files, unique in its table
    cells : variable -> text
    line : where it stands in its file, 0 for a condition without a file
    """

    name: str
    cells: Mapping[str, str]
    line: int = 0

    @property
    def parent_scene(self) -> str:
        """The parent scene that the row names for itself, as RenderToolbox3 or 4 called that column."""
        return self.cells.get("colladaFile") or self.cells.get("parentScene", "")


@dataclass(frozen=True)
class Conditions:
    """
    A table: its variables and its rows, in the order of the file, and what is odd about it.

    ``left_out`` counts the rows of an old table that had too few or too many cells.

    Iterate over it for its conditions; ``conditions[name]`` finds one.
    """

    variables: tuple[str, ...]
    rows: tuple[Condition, ...]
    remarks: tuple[Remark, ...] = field(default=(), compare=False)
    left_out: int = field(default=0, compare=False)

    @classmethod
    def single(cls, base: str) -> Conditions:
        """Return the one condition, named after the recipe, of a recipe without a table."""
        return cls((), (Condition(base, {}),))

    def __iter__(self) -> Iterator[Condition]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Condition:
        for condition in self.rows:
            if condition.name == name:
                return condition
        names = choices(name, (each.name for each in self.rows))
        raise RecipeError(f"no condition is called {name}, there are {names}")


def read_conditions(path: Path | str, base: str, *, old: bool = False) -> Conditions:
    """
    Read a table of conditions.

    Parameters
    ----------
    base : rows without imageName are called base-001, base-002 ...
    old : leave out rows of too few or too many cells, with a remark, as RenderToolbox3 did without one
    """
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read the conditions {path}: {error.strerror}") from error
    return parse_conditions(decoded(content), path, base, old=old)


def decoded(content: bytes) -> str:
    """Return the text of an old file: UTF-8, or what Latin-1 makes of it."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def parse_conditions(text: str, file: str | Path, base: str, *, old: bool = False) -> Conditions:
    """Return the table in a text; its first line that is no comment names the variables."""
    lines = [
        (number, _CELL.findall(line)) for number, line in enumerate(text.split("\n"), 1) if _counts(line)
    ]
    if not lines:
        raise RecipeError("an empty table, its first line must name the variables", file)
    (first, header), *rows = lines
    variables = tuple(header)
    odd = [Remark(message, str(file), first) for message in _oddities(header, bool(rows))]
    every = len(rows)
    if old:
        odd += [
            Remark(f"{_counted(cells, variables)}, the row is left out", str(file), line)
            for line, cells in rows
            if len(cells) != len(variables)
        ]
        rows = [(line, cells) for line, cells in rows if len(cells) == len(variables)]
    conditions = [
        _row(variables, cells, (file, line), f"{base}-{k:03}") for k, (line, cells) in enumerate(rows, 1)
    ]
    _refuse_twins(conditions, file)
    return Conditions(variables, tuple(conditions), tuple(odd), every - len(rows))


def format_conditions(conditions: Conditions) -> str:
    """Return the text that parse_conditions() reads back as the same table."""
    rows = [[row.cells[name] for name in conditions.variables] for row in conditions]
    return "".join(_formatted(cells) for cells in [list(conditions.variables), *rows])


def _counts(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith("%")


def _oddities(header: list[str], has_rows: bool) -> Iterator[str]:
    for name in dict.fromkeys(header):
        if header.count(name) > 1:
            yield f"{name} names {header.count(name)} columns, the first one counts"
        if "," in name:
            yield f"the comma belongs to the name '{name}', write tabs between names"
        if name != name.strip():
            yield f"the blanks belong to the name '{name}'"
    if not has_rows:
        yield "no rows follow the names of the variables, so there is no condition"


def _row(
    variables: tuple[str, ...], cells: list[str], place: tuple[str | Path, int], default: str
) -> Condition:
    if len(cells) != len(variables):
        raise RecipeError(_counted(cells, variables), *place)
    # Of columns with the same name the first counts.
    filled = dict(reversed(list(zip(variables, cells, strict=True))))
    name = filled.get(NAME, default)
    if _UNSAFE.search(name) or _RESERVED.fullmatch(name) or len(name) > _LONGEST:
        message = f"'{name}' cannot name files, use letters, digits, - and _ for {NAME}"
        raise RecipeError(message, *place)
    return Condition(name, {variable: filled[variable] for variable in variables}, place[1])


def _refuse_twins(conditions: list[Condition], file: str | Path) -> None:
    """Refuse two rows with one name, also where only the case differs: some disks keep one file then."""
    seen: dict[str, Condition] = {}
    for condition in conditions:
        if (first := seen.setdefault(condition.name.casefold(), condition)) is not condition:
            message = f"{NAME} {condition.name} stands in line {first.line} already, each row needs its own"
            raise RecipeError(message, file, condition.line)


def _formatted(cells: list[str]) -> str:
    line = "".join(f"{cell}\t" for cell in cells)
    if _CELL.findall(line) != cells or "\n" in line or not _counts(line):
        shown = ", ".join(map(repr, cells))
        raise RecipeError(
            f"a table cannot hold the cells {shown}: no empty cells, tabs, line ends or leading %"
        )
    return line + "\n"


def _counted(cells: list[str], variables: tuple[str, ...]) -> str:
    counts = f"{_count(len(cells), 'value')} for {_count(len(variables), 'variable')}"
    return f"{counts} ({', '.join(variables)})"


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
