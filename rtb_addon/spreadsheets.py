"""Tables as spreadsheets write and paste them: cells between tabs, semicolons or commas, or quoted."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Sequence

SEPARATORS = "\t;,"
_BREAKS = re.compile(r"\s*[\r\n\t]\s*")


def parse_rows(text: str) -> list[list[str]]:
    """
    Return the cells of each line that is not empty; tabs separate them, else semicolons, else commas.

    Lines and tabs within a quoted cell become blanks: no table of conditions could hold them.
    """
    import csv  # not before a table is read: Blender's start does not wait for it

    first = next((line for line in text.splitlines() if line.strip()), "")
    separator = next((each for each in SEPARATORS if each in first), "\t")
    rows = csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""), delimiter=separator)
    plain = ([_BREAKS.sub(" ", cell.strip()) for cell in row] for row in rows)
    return [row for row in plain if any(row)]


def format_rows(rows: Iterable[Sequence[str]], separator: str = "\t") -> str:
    """Return the text that parse_rows() reads back as the same cells."""
    import csv

    written = io.StringIO()
    csv.writer(written, delimiter=separator, lineterminator="\n").writerows(rows)
    return written.getvalue()
