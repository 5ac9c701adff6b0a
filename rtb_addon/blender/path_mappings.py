"""What tells parent scenes apart as mappings of paths, what varies taken from the table where it says it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from ..scene.collada.ids import clean
from ..scene.collada.write_numbers import shortest
from .table import Table


def paths_text(values: Mapping[str, Sequence[str]], table: Table) -> str:
    """
    Return the mappings that set what stands at paths of the parent scene; what varies becomes columns.

    Parameters
    ----------
    values : path -> the text there in each condition
    """
    lines = "".join(f"    {path} = {_path_value(path, texts, table)}\n" for path, texts in values.items())
    return f"Collada {{\n{lines}}}\n" if lines else ""


def _path_value(path: str, texts: Sequence[str], table: Table) -> str:
    """Return a value word by word: what is always the same stands there, the rest comes from the table."""
    words = [text.split() for text in texts]
    if len({len(each) for each in words}) > 1:
        return f"({table.varied(clean(path.partition(':')[0]), texts)})"
    return " ".join(_path_word(path, word, table) for word in zip(*words, strict=True))


def _path_word(path: str, texts: Sequence[str], table: Table) -> str:
    if len(set(texts)) == 1:
        return texts[0]
    for variable in table.variables:
        if all(_is_number(row.get(variable, ""), text) for row, text in zip(table.cells, texts, strict=True)):
            return f"({variable})"
    owner, *_, last = re.split(r"[:|=]", path)
    return f"({table.varied(clean(f'{owner}_{last}'), texts)})"


def _is_number(cell: str, text: str) -> bool:
    """Return whether a cell says the same number as a text, to the last digit of single precision."""
    try:
        return shortest(float(cell)) == shortest(float(text))
    except ValueError:
        return False
