"""RenderToolbox3's units: spectra of lights are total power, so that all is 1/(4 pi) of what it is in SI."""

import json
import math
import runpy
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.recipe import Recipe
from rtb_addon.recipe.options import Conventions
from tests.renderings.old_files import RENDERERS, ROOT, RTB3, old, rendered, said

FACTOR = 1 / (4 * math.pi)
SMALL = {"width": 24, "height": 24, "samples": 16}


@pytest.fixture(scope="module", params=["old", "ours"])
def both(request, tmp_path_factory):
    """The same recipe in SI and in RenderToolbox3's units, and one of its conditions."""
    make = {"old": old_square, "ours": our_radiance_test}[request.param]
    return {units: make(units, tmp_path_factory.mktemp(units)) for units in ("si", "rtb3")}


def old_square(units, folder):
    files = [
        old("ExampleScenes", "SimpleSquare", f"SimpleSquare{end}")
        for end in (".dae", "Conditions.txt", "Mappings.txt")
    ]
    said("import", *files, "--output", folder, "--convention", units, "--data", RTB3 / "RenderData")
    return Recipe.load(folder), "SimpleSquare-004", 30.294


def our_radiance_test(units, folder):
    make_recipe = runpy.run_path(str(ROOT / "examples/radiance_test/make_recipe.py"))["make_recipe"]
    recipe = replace(make_recipe(folder), conventions=Conventions(units))
    recipe.save()
    return Recipe.load(folder), "reference", 3.183099e-5


@pytest.mark.parametrize("renderer", RENDERERS)
def test_everything_is_a_fourth_part_of_one_over_pi(both, renderer):
    cubes = {}
    for units, (recipe, name, _) in both.items():
        cubes[units] = rendered(recipe, name, renderer=renderer, **SMALL)
        record = json.loads(
            recipe.overridden(renderer=renderer).record_file(recipe.conditions[name]).read_text()
        )
        assert cubes[units].attributes["units"] == record["conventions"]["units"] == units
        assert cubes[units].factor == record["factor"]
    assert cubes["si"].radiance.max() > 0
    expected = cubes["si"].radiance * np.float32(FACTOR)
    np.testing.assert_array_equal(cubes["rtb3"].radiance, expected)
    assert cubes["rtb3"].factor == pytest.approx(cubes["si"].factor * FACTOR, rel=1e-12)


@pytest.mark.parametrize("renderer", RENDERERS)
def test_the_stated_radiance_at_520_nm_comes_out_in_both_units(both, renderer):
    for units, (recipe, name, radiance) in both.items():
        cube = rendered(recipe, name, renderer=renderer, band_kind="centre", **SMALL)
        expected = radiance * (FACTOR if units == "rtb3" else 1)
        assert cube.radiance[11:13, 11:13, 12].mean() == pytest.approx(expected, rel=1e-3)


def test_check_explains_units_and_handedness_in_a_sentence(both):
    for units, (recipe, _, _) in both.items():
        *_, last = said("check", recipe.folder).splitlines()
        words = {
            "si": "units si: a point light's numbers are W sr-1 nm-1",
            "rtb3": "units rtb3: light spectra are total power, every radiance is multiplied by 1/(4 pi)",
        }
        hands = {
            "blender": "handedness blender: pictures show what Blender's camera shows",
            "rtb3": "handedness rtb3: pictures are mirrored unless a mapping flips the camera",
        }
        assert words[units] in last
        assert hands[recipe.conventions.handedness] in last


def test_an_old_file_keeps_its_handedness_whatever_its_units(both):
    hands = {recipe.conventions.handedness for recipe, _, _ in both.values()}
    old_one = "imported from" in both["si"][0].provenance
    assert hands == {"rtb3" if old_one else "blender"}
