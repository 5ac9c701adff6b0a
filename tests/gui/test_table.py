"""Spectra and the table of conditions in a real window; photographs stay in build/screenshots."""

import pytest

SCRIPT = "in_table.py"
WINDOW = True
PANELS = (
    "conditions-none",
    "conditions",
    "conditions-library",
    "conditions-random",
    "conditions-menu",
    "conditions-many",
    "conditions-variable",
    "conditions-pairs",
    "conditions-pictures",
    "conditions-unchecked",
    "conditions-reading",
    "spectrum-material",
    "spectrum-light",
    "spectrum-wrong",
    "spectrum-search",
    "spectrum-menu",
    "vary-menu",
    "varied",
)


@pytest.mark.parametrize("name", PANELS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_a_spectrum_is_found_by_typing_a_part_of_its_name(report):
    assert report["searched"].endswith("/yellow green")


def test_a_right_click_makes_a_reflectance_a_variable(report):
    assert report["varied"] == ["(reflectance)", ["reflectance"], [report["searched"]]]


def test_a_thousand_rows_scroll_smoothly(report):
    many = report["many"]
    assert many["draws"] >= 20
    # Blender asks only for the rows that are seen: six, and at the edge one more.
    assert many["items"] <= 8 * many["draws"]
    assert report["a draw"] < 0.005
    assert report["a draw with states"] < 0.005


def test_a_thousand_rows_are_filled_in_at_once(report):
    assert report["filling"] < 1.0


def test_rows_that_are_rendered_show_small_pictures(report):
    assert report["pictures"] == [True] * 6
    changed, moved = report["states"]
    assert changed == ["done", "changed", *["done"] * 4]
    assert moved == ["unchecked", "changed", *["unchecked"] * 4]


def test_a_scene_is_read_condition_by_condition_and_esc_leaves_it_as_it_was(report):
    reading = report["reading"]
    assert 0 < reading["share"] < 1
    assert reading["left"]
    assert (reading["height"], reading["objects"]) == (0, 3)
    assert reading["turn"] < 0.05
