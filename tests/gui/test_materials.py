"""Spectral materials, lamps and worlds in a real window; photographs stay in build/screenshots."""

import pytest

SCRIPT, WINDOW = "in_materials.py", True
PANELS = (
    "material-matte",
    "material-metal",
    "material-glass",
    "material-renderers",
    "library-search",
    "spectrum-table",
    "spectrum-flat",
    "spectrum-curve",
    "light-watts",
    "light-lux",
    "world-constant",
    "world-image",
    "world-sky",
    "assets",
    "assets-dragged",
)


@pytest.mark.parametrize("name", PANELS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_the_default_material_is_taken_over_as_matte(report):
    assert report["promoted"] == "matte"


def test_a_number_typed_in_a_dialog_is_used(report):
    assert report["flat"] == "1"


def test_a_point_of_a_curve_is_dragged_up(report):
    drawn, left = report["drawn"]
    values = dict(pair.split(":") for pair in drawn.split())
    assert float(values["450"]) > 0.4, "it was 0.31"
    assert float(values["580"]) == 0.038, "points far away stay"
    assert left == 0


def test_a_panel_of_many_spectra_draws_at_once(report):
    assert report["a draw"] < 0.005


def test_the_lamps_panel_tells_what_its_light_comes_to(report):
    told = dict(report["told"])
    assert told["CCT"] == "4225 K"
    assert told["CRI (Ra)"] == "64"
    assert told["Intensity"].endswith("W/sr")
    assert told[""] == "500 cd"


def test_the_installed_zip_brings_its_materials_to_the_asset_browser(report):
    assert report["asset libraries"] == ["RenderToolbox"]
    assert report["assets"] > 70


def test_a_shipped_material_is_dragged_on_the_cube_and_taken_back(report):
    name, spectral, reflectance = report["dragged"]
    assert spectral
    assert reflectance == f"BabelColor Average/{name}"
    assert report["dragged, undone"] == "Material"


def test_a_material_saved_by_blender_4_is_what_it_was(report):
    assert report["appended"] == ["metal", "Metals/Au gold eta"]
