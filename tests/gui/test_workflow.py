"""The workflow in a real window: what varies, is previewed, checked, listed and rendered, photographed."""

from pathlib import Path

import numpy as np
import pytest

from rtb_addon.spectral_image import SpectralImage

SCRIPT = "in_workflow.py"
WINDOW = True
PANELS = (
    "workflow-unsaved",
    "workflow-search",
    "preferences",
    "workflow-vary",
    "workflow-preview",
    "workflow-mappings",
    "workflow-text",
    "workflow-check",
    "workflow-checked",
    "workflow-rendering",
)


@pytest.mark.parametrize("name", PANELS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_a_file_that_was_never_saved_is_asked_where_to_go(report):
    assert report["asked to save"]


def test_commands_are_found_by_their_names(report):
    assert any("World" in each for each in report["checked by name"])


def test_a_right_click_makes_one_component_of_a_location_a_variable(report):
    assert report["varied"] == [["Location Z of the object Light", "(light_location_z)"]]
    assert report["variables"] == [["paint", "SPECTRUM"], ["light_location_z", "NUMBER"]]


def test_the_preview_follows_the_active_row_and_goes_without_a_trace(report):
    assert report["heights"] == [3.0, 4.0, 5.0]
    assert report["height afterwards"] == pytest.approx(5.9038619995)


def test_the_preview_never_gets_into_a_file_and_comes_back_after_saving_and_undo(report):
    assert report["height saved"] == pytest.approx(5.9038619995)
    assert report["heights shown again"] == [0, 0, 0, 0]
    assert report["cube"] == 0


def test_check_finds_everything_at_once_and_knows_what_each_finding_is_about(report):
    errors, culprits = report["errors"], report["culprits"]
    assert len(errors) == 3
    assert {tuple(each) for each in culprits.values()} >= {
        ("condition", "green"),
        ("light", "Light"),
        ("mapping", "2"),
    }
    assert report["selected"] == "Light"
    assert report["mended"] == []


def test_one_condition_is_rendered_alone(report):
    assert report["rendered alone"] == ["green"]


def test_a_click_the_command_line_and_a_script_render_the_same_cube_bit_for_bit(report):
    clicked, *others = (SpectralImage.load(Path(file)).radiance for file in report["cubes"])
    assert clicked.any()
    for other in others:
        np.testing.assert_array_equal(clicked, other)


def test_the_preferences_test_what_the_zip_brought(report):
    assert report["renderers"] == {"mitsuba": True, "sphere": True, "tracer": True}


def test_conditions_under_way_have_bars_of_their_own(report):
    assert report["under way"]
