"""RenderToolbox4's mappings as blocks, which Blender keeps: filled in, what varies becomes columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..scene.adjustments import Adjustments, MatrixEdit, PathEdit
from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import numbers

_COLLADA = ("Collada", 0)
Line = tuple[tuple[str, int], str, str]  # block and its number, left side, value; declarations have none


def as_blocks(rows: Sequence[Adjustments], removals: Sequence[str] = ()) -> tuple[str, dict[str, list[str]]]:
    """
    Return a text of blocks that says the same for some rows, and new columns: a cell for each of the rows.

    Rows for which other things change than for others have blocks of their own, of a group that they name.

    Parameters
    ----------
    rows : what the mappings say for each; nodes that they place are to have one matrix
    removals : ids that are deleted elsewhere, so that nothing need be said of them
    """
    alike: dict[tuple, dict[int, list[Line]]] = {}
    for place, row in enumerate(rows):
        lines = list(_lines(row, removals))
        alike.setdefault(tuple((kind, left) for kind, left, _ in lines), {})[place] = lines
    columns: dict[str, list[str]] = {}
    if len(alike) > 1:
        columns["groupName"] = [""] * len(rows)
    texts = []
    for count, members in enumerate(alike.values(), 1):
        group = f"group{count}" if len(alike) > 1 else ""
        for place in members if group else ():
            columns["groupName"][place] = group
        texts.append(_blocks(members, group, len(rows), columns))
    return "".join(texts), columns


def _blocks(members: Mapping[int, list[Line]], group: str, count: int, columns: dict[str, list[str]]) -> str:
    """Return the blocks of rows for which the same things change; what varies becomes columns."""
    blocks: list[str] = []
    before = ("", 0)
    for same in zip(*members.values(), strict=True):
        block, left, _ = same[0]
        if block != before:
            head = f"{block[0]} {group} {{" if group else f"{block[0]} {{"
            blocks += ["}", head] if before[0] else [head]
            before = block
        cells = dict(zip(members, (value for *_, value in same), strict=True))
        blocks.append(f"    {left}{_value(left, cells, count, columns)}")
    return "\n".join([*blocks, "}", ""]) if blocks else ""


def _value(left: str, cells: Mapping[int, str], count: int, columns: dict[str, list[str]]) -> str:
    """Return the right side of a line, a variable where it is not the same everywhere."""
    first = next(iter(cells.values()))
    if not first:
        return ""
    if len(set(cells.values())) == 1:
        return f" = {first}"
    name = clean(left).strip("_")
    while name in columns:
        name += "_"
    columns[name] = [cells.get(place, first) for place in range(count)]  # others do not ask
    return f" = ({name})"


def _lines(said: Adjustments, removals: Sequence[str]) -> Iterator[Line]:
    for edit in said.edits:
        if isinstance(edit, PathEdit) and edit.path.split(":")[0] not in removals:
            yield _COLLADA, edit.path, edit.value
        elif isinstance(edit, MatrixEdit) and edit.node not in removals:
            yield _COLLADA, f"{edit.node}:matrix|sid=transform", numbers(edit.numbers)
    count, known = 0, set()
    for each in said.objects:
        if each.id in known:  # what is said of it once more needs a block of its own
            count, known = count + 1, set()
        known.add(each.id)
        if each.category:
            yield ("Generic", count), f"{each.id}:{each.category}:{each.model}", ""
        for one in each.properties:
            kind = f".{one.type}" if one.type else ""
            yield ("Generic", count), f"{each.id}:{one.name}{kind}", one.value
    for line in said.native:
        left, _, value = line.text.partition(" = ")
        yield (line.block or "Mitsuba", 0), left, value
