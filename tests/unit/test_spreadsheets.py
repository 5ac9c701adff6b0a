"""Tables from and to spreadsheets."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtb_addon.spreadsheets import format_rows, parse_rows

CELL = st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Z"]), min_size=1)


def test_what_a_spreadsheet_copies_is_read_cell_by_cell():
    assert parse_rows("imageName\tpaint\r\nnoon\t400:0.2 700:0.8\r\n\r\n") == [
        ["imageName", "paint"],
        ["noon", "400:0.2 700:0.8"],
    ]


@pytest.mark.parametrize("separator", ["\t", ";", ","])
def test_cells_may_hold_the_separator_and_quotes(separator):
    said = 'one two "three"' if separator == "\t" else f'one{separator}two "three"'
    rows = [["name", "said"], ["a", f'one{separator}two "three"'], ["b", ""]]
    assert parse_rows(format_rows(rows, separator)) == [rows[0], ["a", said], rows[2]]


def test_lines_within_a_cell_become_one():
    assert parse_rows('a\tb\n"two\r\n lines"\t3\n') == [["a", "b"], ["two lines", "3"]]


@given(st.lists(st.lists(CELL, min_size=2, max_size=2), min_size=1))
def test_any_table_survives_the_clipboard(rows):
    assert parse_rows(format_rows(rows)) == rows
