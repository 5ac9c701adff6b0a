"""Lines of a Mitsuba block that change how a picture is computed, and those that change the noise alone."""

from dataclasses import astuple

import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.renderers.native_lines import ENDLESS, integrator_with
from rtb_addon.scene.adjustments import NativeLine
from rtb_addon.scene.render_scene import Integrator

DIRECT, PATH = Integrator("direct", 2, 64), Integrator("path", 6, 64)


def changed(integrator, *texts):
    lines = [NativeLine(text, "mappings.txt", 7) for text in texts]
    return astuple(integrator_with(integrator, lines, "Mitsuba"))


def test_paths_in_a_recipe_of_direct_light_have_no_end():
    assert changed(DIRECT, "integrator:integrator:path") == ("path", ENDLESS, 64, 0, 0)
    assert changed(DIRECT, "integrator:integrator:path", "integrator:maxDepth.integer = 7")[1] == 7
    assert changed(PATH, "integrator:maxDepth.integer = -1")[1] == ENDLESS


def test_paths_in_a_recipe_of_paths_stay_as_long_as_it_says():
    assert changed(PATH, "integrator:integrator:path") == astuple(PATH)


@pytest.mark.parametrize("name", ["bdpt", "volpath", "volpath_simple"])
def test_an_integrator_that_comes_to_the_same_picture_is_a_path(name):
    assert changed(PATH, f"integrator:integrator:{name}") == astuple(PATH)


@pytest.mark.parametrize(
    "text",
    [
        "integrator:shadingSamples.integer = 32",
        "integrator:sampleDirect.boolean = true",
        "integrator:hideEmitters.boolean = false",
        "Camera-camera_sampler:sampler:ldsampler",
        "Camera-camera_sampler:pixelSamples.integer = 32",
        "Side-material:ensureEnergyConservation.boolean = false",
        "filter:rfilter:box",
    ],
)
def test_a_line_that_changes_no_more_than_the_noise_is_taken(text):
    assert changed(PATH, text) == astuple(PATH)


@pytest.mark.parametrize(
    "text",
    [
        "integrator:integrator:photonmapper",
        "integrator:hideEmitters.boolean = true",
        "Camera-camera:sensor:thinlens",
        "Camera-camera:shadingSamples.integer = 32",
        "Side-material:ensureEnergyConservation.boolean = true",
        "filter:rfilter:gaussian",
        "filter:stddev.float = 0.25",
    ],
)
def test_a_line_that_would_change_the_picture_is_refused_where_it_stands(text):
    with pytest.raises(RecipeError, match=r"^mappings.txt:7: Mitsuba has no use for '") as refused:
        changed(PATH, text)
    assert text in str(refused.value)
