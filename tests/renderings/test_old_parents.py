"""Several parent scenes in one recipe: RenderToolbox3's colladaFile column, where each row names its own."""

import numpy as np
import pytest

from rtb_addon import SceneBuilder
from rtb_addon.batch import render_recipe
from rtb_addon.conditions import parse_conditions
from rtb_addon.recipe import Recipe, write_recipe
from rtb_addon.recipe.options import Conventions, MontageOptions, RecipeOptions
from rtb_addon.scene.build import Placement
from tests.renderings.old_files import RENDERERS, rendered, said

TABLE = """\
imageName	colladaFile	paint
left-dark	left.dae	0.2
right-dark	right.dae	0.2
left	left.dae	0.8
"""
MAPPINGS = """\
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = 300:(paint) 800:(paint)
    Sun-light:light:directional
    Sun-light:intensity.spectrum = 300:3 800:3
}
"""
SIDES = {"left": -1.0, "right": 1.0}
OPTIONS = RecipeOptions(width=16, height=8, integrator="direct", depth=2, samples=4)


def parent(place: float) -> bytes:
    """Return a square of 1 m left or right of the middle, seen by a camera and lit by a sun."""
    scene = SceneBuilder()
    scene.plane("Square", 1, 1, "Paint", Placement((place, 0, 0)))
    scene.sun("Sun", placement=Placement((0, 0, 5)))
    scene.camera("Camera", 90, placement=Placement((0, 0, 2)))
    return scene.tobytes()


@pytest.fixture
def recipe(tmp_path):
    return write_recipe(
        tmp_path / "family",
        "family",
        OPTIONS,
        Conventions(),
        MontageOptions(),
        parent(0),
        parse_conditions(TABLE, "conditions.txt", "family"),
        MAPPINGS,
        {f"{name}.dae": parent(place) for name, place in SIDES.items()},
        {},
    )


@pytest.fixture
def imported(tmp_path):
    """The same three scenes as old files, imported."""
    for name, place in SIDES.items():
        (tmp_path / f"{name}.dae").write_bytes(parent(place))
    files = [tmp_path / name for name in ("parent.dae", "conditions.txt", "mappings.txt")]
    for file, content in zip(files, (parent(0), TABLE.encode(), MAPPINGS.encode()), strict=True):
        file.write_bytes(content)
    folder = tmp_path / "imported"
    said("import", *files, "--output", folder)
    return Recipe.load(folder)


@pytest.mark.parametrize("renderer", RENDERERS)
@pytest.mark.parametrize(("source", "mirrors"), [("recipe", False), ("imported", True)])
def test_each_row_shows_its_own_parent_scene(request, source, mirrors, renderer):
    recipe = request.getfixturevalue(source)
    for name, paint in (("left-dark", 0.2), ("right-dark", 0.2), ("left", 0.8)):
        radiance = rendered(recipe, name, renderer=renderer, width=16, height=8, samples=4).radiance
        halves = {"left": radiance[:, :8], "right": radiance[:, 8:]}
        # An old camera that no mapping mirrors shows left on the right.
        side = name.split("-")[0]
        seen_on = {"left": "right", "right": "left"}[side] if mirrors else side
        np.testing.assert_allclose(halves.pop(seen_on).max(axis=(0, 1)), 3 * paint / np.pi, rtol=1e-5)
        assert next(iter(halves.values())).max() == 0


def test_a_changed_parent_scene_renders_only_its_own_rows_again(recipe):
    assert done(recipe) == {"left-dark": "done", "right-dark": "done", "left": "done"}
    assert set(done(recipe).values()) == {"cached"}
    (recipe.folder / "resources" / "right.dae").write_bytes(parent(0.5))
    assert done(recipe) == {"left-dark": "cached", "right-dark": "done", "left": "cached"}
    # The recipe's own parent scene is nobody's: no row is without a name.
    (recipe.folder / "parent.dae").write_bytes(parent(0.25))
    assert set(done(recipe).values()) == {"cached"}


def test_a_parent_scene_that_is_not_there_is_named_with_its_row(recipe):
    (recipe.folder / "resources" / "right.dae").unlink()
    sentences = [str(each) for each in recipe.problems()]
    assert len(sentences) == 1
    assert sentences[0].startswith("conditions.txt:3: the parent scene right.dae is not in ")


def done(recipe):
    events = render_recipe(recipe.folder, renderer="tracer", jobs=1)
    return {each.condition: each.kind for each in events if each.kind in ("done", "cached", "failed")}
