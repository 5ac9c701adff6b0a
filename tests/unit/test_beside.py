"""What a recipe wants beside its radiance cubes, and when it wants a rendering to end."""

import json

import numpy as np
import pytest

from rtb_addon.batch import render_condition, render_recipe
from rtb_addon.errors import RecipeError
from rtb_addon.layers import Layers
from rtb_addon.recipe import Recipe
from rtb_addon.recipe.options import Conventions, RecipeOptions
from rtb_addon.spectral_image import SpectralImage


def layers_of(recipe, name):
    return Layers.load(recipe.layers_file(recipe.conditions[name]))


def test_the_layers_that_a_recipe_wants_lie_beside_its_cube(write_family):
    recipe = write_family({"a": "0.8"}, layers=("depth", "albedo", "direct", "standard_error"))
    assert [event.kind for event in render_recipe(recipe.folder, jobs=1)][-1] == "finished"
    found = layers_of(recipe, "a")
    assert set(found.planes) == {"depth", "albedo", "direct", "standard_error"}
    np.testing.assert_allclose(found.planes["albedo"], 0.8, rtol=1e-6)
    np.testing.assert_allclose(found.planes["standard_error"], 0.008, rtol=1e-6)
    cube = SpectralImage.load(recipe.rendering_file(recipe.conditions["a"]))
    np.testing.assert_array_equal(cube.bands.centres, found.bands.centres)


def test_radiance_among_the_layers_is_in_the_units_of_the_recipe(write_family):
    conventions = Conventions(units="rtb3")
    recipe = write_family(
        {"a": "0.8"}, conventions=conventions, layers=("albedo", "direct", "standard_error")
    )
    render_condition(recipe, "a")
    planes = layers_of(recipe, "a").planes
    np.testing.assert_allclose(planes["albedo"], 0.8, rtol=1e-6)
    np.testing.assert_allclose(planes["direct"], 0.8 / (4 * np.pi), rtol=1e-6)
    np.testing.assert_allclose(planes["standard_error"], 0.008 / (4 * np.pi), rtol=1e-6)


def test_a_recipe_that_wants_no_layers_gets_no_file(write_family):
    recipe = write_family({"a": "0.8"})
    render_condition(recipe, "a")
    assert not (recipe.folder / "layers").exists()


def test_check_and_render_say_that_a_renderer_knows_no_layers(write_family):
    recipe = write_family({"a": "0.8"}, renderer="sphere", layers=("depth",))
    sentence = "layers are depth, the renderer sphere knows none, leave them empty"
    assert sentence in map(str, recipe.problems())
    with pytest.raises(RecipeError):
        render_condition(recipe, "a")


def test_when_a_rendering_is_to_end_reaches_the_renderer_and_the_record(write_family):
    recipe = write_family({"a": "0.8"}, until_seconds=9.5, until_error=0.01)
    done = render_condition(recipe, "a", gpu=True)
    assert done.record["renderer says"] == {"seconds": "9.5", "error": "0.01", "gpu": "True"}
    assert done.record["options"]["until_error"] == 0.01


def test_what_is_wrong_with_a_crop_or_layers_is_said_in_one_sentence(write_family):
    with pytest.raises(ValueError, match="crop reaches to 5 x 3 pixels, the picture has 4 x 3"):
        RecipeOptions(width=4, height=3, crop=(1, 0, 4, 3))
    recipe = write_family({"a": "0.8"})
    words = json.loads((recipe.folder / "recipe.json").read_text())
    words["options"]["layers"] = ["depth", "colour"]
    (recipe.folder / "recipe.json").write_text(json.dumps(words))
    with pytest.raises(RecipeError, match=r'layers is \["depth", "colour"\], it must be names out of depth'):
        Recipe.load(recipe.folder)


def test_options_come_back_from_the_folder_as_they_were(write_family):
    said = {"crop": (1, 0, 2, 2), "layers": ("depth", "uv"), "filter": "gaussian", "roulette": 5}
    recipe = write_family({"a": "0.8"}, **said)
    options = Recipe.load(recipe.folder).options
    assert {name: getattr(options, name) for name in said} == said
