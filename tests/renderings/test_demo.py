"""The colour checker of monkeys, as `make demo` models it: both renderers agree on it within their noise."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.batch.rendering import render_condition
from rtb_addon.recipe import Recipe
from rtb_addon.spectra import DEFAULT_BANDS, library
from tests.renderings.noise import CHANCE, error_of_mean, in_blocks, least_probability

ROOT = Path(__file__).resolve().parents[2]
NAMES = ("mitsuba", "tracer")
SEEDS = 12
WIDTH, HEIGHT, BLOCK = 40, 32, 8

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("bpy") is None,
    reason="BLENDER'S PYTHON PACKAGE IS NOT HERE: pip install bpy to model the demo",
)


@pytest.fixture(scope="module")
def recipe(tmp_path_factory):
    """The demo, modelled with Blender's Python package in a process of its own."""
    blender, folder = tmp_path_factory.mktemp("blender"), tmp_path_factory.mktemp("demo")
    surroundings = {**os.environ, "BLENDER_USER_RESOURCES": str(blender)}
    for command in (
        ["packaging/link_extension.py"],
        ["examples/dragon_color_checker/model.py", "--", "--output", str(folder)],
    ):
        subprocess.run(
            [sys.executable, *command], check=True, cwd=ROOT, env=surroundings, capture_output=True
        )
    return Recipe.load(folder)


def rendered(recipe, renderer, condition, seed):
    options = {"renderer": renderer, "width": WIDTH, "height": HEIGHT, "samples": 64, "seed": seed}
    return render_condition(recipe.overridden(**options), condition, lambda fraction: None).image.radiance


@pytest.fixture(scope="module")
def red(recipe):
    """Each renderer's (seeds, places, bands) means of the red monkey; no two renderings share a seed."""
    return {
        name: np.stack(
            [in_blocks(rendered(recipe, name, "red", 100 * first + seed), BLOCK) for seed in range(SEEDS)]
        )
        for first, name in enumerate(NAMES, start=1)
    }


def test_both_renderers_agree_on_the_red_monkey_in_every_band(red):
    assert least_probability(*red.values()) > CHANCE


def test_the_noise_on_the_red_monkey_is_small_enough_to_tell(red):
    ours, theirs = red.values()
    assert max(error_of_mean(seeds[:, -1]).max() for seeds in (ours, theirs)) < 0.001
    assert least_probability(ours, 1.01 * theirs) < CHANCE


@pytest.mark.parametrize("name", NAMES)
def test_a_monkey_in_direct_light_has_its_patchs_colour(recipe, name):
    """A family shares its seed and differs in what varies only: the monkey's radiance, as its paints do."""
    paints = {"red": "red", "white-9.5": "white 9.5 (.05 D)"}
    options = {"renderer": name, "width": WIDTH, "height": HEIGHT, "samples": 16, "integrator": "direct"}
    once = {
        condition: render_condition(recipe.overridden(**options), condition, lambda fraction: None).image
        for condition in paints
    }
    middle = {condition: image.radiance[13:19, 17:23].astype(float) for condition, image in once.items()}
    reflectance = {
        c: library.find(f"BabelColor Average/{p}").in_bands(DEFAULT_BANDS) for c, p in paints.items()
    }
    assert middle["red"].min() > 0
    ratio = middle["red"] / middle["white-9.5"]
    expected = np.broadcast_to(reflectance["red"] / reflectance["white-9.5"], ratio.shape)
    np.testing.assert_allclose(ratio, expected, rtol=2e-5)
    # What does not show the monkey does not change.
    walls = [image.radiance[:4, :4] for image in once.values()]
    np.testing.assert_allclose(walls[0], walls[1], rtol=1e-6)
