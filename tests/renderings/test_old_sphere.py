"""
The MaterialSphere, matte: a point lamp's light on a ball is its reflectance times cos t / (pi d^2).

The lamp stands at (0, 5, 5), the camera at (0, 0, 5), the ball of 1 m at the origin.
"""

import math

import numpy as np
import pytest
from scipy import ndimage

from rtb_addon import SceneBuilder
from rtb_addon.conditions import Conditions
from rtb_addon.recipe import Recipe, write_recipe
from rtb_addon.recipe.options import Conventions, MontageOptions, RecipeOptions
from rtb_addon.scene.build import Placement
from rtb_addon.spectra import DEFAULT_BANDS
from rtb_addon.spectra.files import read_spd
from tests.renderings.old_files import RENDERERS, RTB3, old, rendered, said

WIDTH, HEIGHT = 200, 160
BLENDERS_DEFAULT_LENS = 49.13434  # [degrees] across the picture, 35 mm on a sensor of 32 mm
LAMP = np.array([0.0, 5.0, 5.0])
MAPPINGS = """\
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = mccBabel-11.spd
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = 300:1 800:1
}
"""


def our_ball(folder):
    scene = SceneBuilder("Ball")
    scene.sphere("Ball", 1, "Paint", segments=160)
    scene.point("Lamp", placement=Placement(tuple(LAMP)))
    scene.camera("Camera", BLENDERS_DEFAULT_LENS, placement=Placement((0, 0, 5)))
    options = RecipeOptions(integrator="direct", depth=2)
    parts = (options, Conventions(), MontageOptions(), scene.tobytes(), Conditions.single("Ball"), MAPPINGS)
    return write_recipe(folder, "Ball", *parts, {}, {}), "Ball"


def old_ball(folder):
    ends = (".dae", "Conditions.txt", "Mappings.txt")
    files = [old("ExampleScenes", "MaterialSphere", f"MaterialSphere{end}") for end in ends]
    said("import", *files, "--output", folder, "--data", RTB3 / "RenderData")
    return Recipe.load(folder), "materialSphereMatte"


@pytest.fixture(scope="module", params=[(name, make) for name in RENDERERS for make in (our_ball, old_ball)])
def ball(request, tmp_path_factory):
    """Radiance over reflectance: (height, width, bands)."""
    renderer, make = request.param
    recipe, name = make(tmp_path_factory.mktemp("ball"))
    cube = rendered(recipe, name, renderer=renderer, width=WIDTH, height=HEIGHT, samples=16)
    paint = read_spd(recipe.find_file("mccBabel-11.spd")).in_bands(DEFAULT_BANDS)
    return cube.radiance.astype(float) / paint


def radiance_of(normal):
    """Return radiance over reflectance where the ball's surface has a normal."""
    to_lamp = LAMP - normal
    distance = np.linalg.norm(to_lamp)
    return max(0.0, normal @ to_lamp / distance) / (math.pi * distance**2)


def picture():
    """Return radiance over reflectance at the middle of every pixel: (height, width)."""
    half = math.tan(math.radians(BLENDERS_DEFAULT_LENS) / 2)
    x = ((np.arange(WIDTH) + 0.5) / WIDTH * 2 - 1) * half
    y = (1 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 2) * half * HEIGHT / WIDTH
    rays = np.stack([*np.meshgrid(x, y), np.full((HEIGHT, WIDTH), -1.0)], axis=2)
    rays /= np.linalg.norm(rays, axis=2, keepdims=True)
    nearest = -rays[..., 2] * 5
    inside = nearest**2 - 24
    normals = np.array([0, 0, 5]) + rays * (nearest - np.sqrt(np.clip(inside, 0, None)))[..., None]
    lit = [[radiance_of(normal) for normal in row] for row in normals]
    return np.where(inside > 0, lit, 0)


def test_the_stated_numbers_are_those_of_the_closed_form():
    assert radiance_of(np.array([0, 1, 1]) / math.sqrt(2)) == pytest.approx(0.0086362, rel=1e-4)
    assert radiance_of(np.array([0.0, 0.0, 1.0])) == pytest.approx(0.0048500, rel=1e-4)


def test_the_middle_of_the_ball_has_the_radiance_of_its_normal(ball):
    middle = ball[HEIGHT // 2 - 2 : HEIGHT // 2 + 2, WIDTH // 2 - 2 : WIDTH // 2 + 2].mean(axis=(0, 1))
    np.testing.assert_allclose(middle, 0.0048500, rtol=0.01)


def test_every_pixel_away_from_the_edges_has_the_radiance_of_its_normal(ball):
    """Facets and what a pixel averages make single pixels differ; all of them together hardly."""
    expected = picture()
    clear = ndimage.binary_erosion(expected > 0.2 * expected.max(), iterations=2)
    assert clear.sum() > 3000
    assert expected.max() == pytest.approx(0.0086362, rel=1e-3)
    ratio = ball[clear] / expected[clear][:, None]
    np.testing.assert_allclose(ratio.mean(axis=0), 1, atol=0.002)
    np.testing.assert_allclose(ratio, 1, atol=0.1)
    brightest = expected > 0.995 * expected.max()
    np.testing.assert_allclose(ball[brightest].mean(axis=0), 0.0086362, rtol=0.005)


def test_the_ball_is_as_large_as_perspective_makes_it_and_dark_below(ball):
    lit = ball[..., 12] > 0
    rows, columns = np.nonzero(lit)
    radius = math.tan(math.asin(1 / 5)) / math.tan(math.radians(BLENDERS_DEFAULT_LENS) / 2) * WIDTH / 2
    assert radius == pytest.approx(44.65, abs=0.01)
    assert (columns.max() + 1 - columns.min()) / 2 == pytest.approx(radius, abs=1)
    assert HEIGHT / 2 - rows.min() == pytest.approx(radius, abs=1)
    # Where the lamp is more than 90 degrees away, at the lower rim, there is no light at all.
    assert rows.max() < HEIGHT / 2 + 0.9 * radius
