"""
The CoordinatesTest: every object stands on its pixel, and the picture is not mirrored.

Positions are those that the camera's own axes give, in pixels from the upper left corner of the picture. A
mirrored picture, a swapped axis or a Y axis taken for Z moves at least one object by more than 20 of them.
"""

import runpy
from pathlib import Path

import numpy as np
import pytest
from scipy import io, ndimage

from rtb_addon import SpectralImage
from rtb_addon.recipe import Recipe
from tests.renderings.old_files import RENDERERS, ROOT, RTB4, old, rendered, said

WIDTH, HEIGHT = 320, 240
# Where the objects of a colour stand, and the band in which that colour is brightest.
PLACES = {
    "red": ((234.1, 139.9), (112.1, 34.5)),
    "green": ((230.7, 17.3), (125.0, 143.8)),
    "blue": ((157.7, 88.1), (179.2, 86.2)),
}
BRIGHTEST = {"red": 25, "green": 15, "blue": 5}
SKY = 0.05
SQUARE = np.ones((3, 3), bool)

# RenderToolbox3's own mirroring, in one group; a sky from which every side of the objects is seen.
GROUPS = "imageName\tgroupName\nlit-all-round\tmirrored\nunmirrored\tnone\n"
MAPPINGS = (
    f"Collada mirrored {{\n    Camera:scale|sid=scale = -1 1 1\n}}\nGeneric {{\n"
    f"    Sky-light:light:environment\n    Sky-light:intensity.spectrum = 300:{SKY} 800:{SKY}\n}}\n"
)


@pytest.fixture(scope="module")
def ours(tmp_path_factory):
    script = ROOT / "examples/coordinates_test/make_recipe.py"
    return runpy.run_path(str(script))["make_recipe"](tmp_path_factory.mktemp("coordinates"))


@pytest.fixture(scope="module")
def olds(tmp_path_factory):
    """The old file with a sky, with and without RenderToolbox3's mirroring."""
    return imported(old("ExampleScenes", "CoordinatesTest", "CoordinatesTest.dae"), tmp_path_factory)


@pytest.fixture(scope="module")
def fourth(tmp_path_factory):
    """The same for the file of RenderToolbox4."""
    return imported(old("Test", "Automated", "Fixture", "CoordinatesTest.dae", at=RTB4), tmp_path_factory)


def imported(parent, tmp_path_factory):
    tables = tmp_path_factory.mktemp("tables")
    files = [tables / "conditions.txt", tables / "mappings.txt"]
    for file, text in zip(files, (GROUPS, MAPPINGS), strict=True):
        file.write_text(text)
    folder = tmp_path_factory.mktemp("old-coordinates")
    said("import", parent, *files, "--output", folder)
    return Recipe.load(folder)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """The old file alone: no tables, RenderToolbox3's default mappings."""
    folder = tmp_path_factory.mktemp("plain-coordinates")
    parent = old("ExampleScenes", "CoordinatesTest", "CoordinatesTest.dae")
    said("import", parent, "--output", folder)
    return Recipe.load(folder)


@pytest.fixture(scope="module", params=RENDERERS)
def lamplit(request, plain):
    """The old picture as it was, by a renderer."""
    return seen(plain, request.param, "CoordinatesTest")


def seen(recipe, renderer, name):
    return rendered(recipe, name, renderer=renderer, width=WIDTH, height=HEIGHT, samples=9).radiance


@pytest.mark.parametrize("renderer", RENDERERS)
@pytest.mark.parametrize("source", ["ours", "olds", "fourth"])
def test_every_object_stands_on_its_pixel(request, source, renderer):
    recipe = request.getfixturevalue(source)
    assert_places(seen(recipe, renderer, "lit-all-round"), PLACES)


@pytest.mark.parametrize("renderer", RENDERERS)
def test_an_old_file_whose_camera_no_mapping_mirrors_shows_mirrored(olds, renderer):
    assert_places(seen(olds, renderer, "unmirrored"), mirrored(PLACES))


@pytest.mark.parametrize("renderer", RENDERERS)
def test_a_mapping_mirrors_a_file_of_ours(ours, renderer):
    """Its lamps and sky are those of the other condition, so it is the same picture turned round."""
    there, back = (seen(ours, renderer, name) for name in ("as-it-is", "mirrored"))
    assert_silhouettes_agree(there.sum(axis=2) > 0, back[:, ::-1].sum(axis=2) > 0)


def test_the_ball_in_front_of_the_lamps_is_a_thin_ring(lamplit):
    ring = lamplit[75:101, 144:171, BRIGHTEST["blue"]]
    assert ring[10:16, 11:17].max() == 0
    for edge in (ring[:6], ring[-6:], ring[:, :6], ring[:, -6:]):
        assert edge.max() > 0.1 * lamplit[86, 179, BRIGHTEST["blue"]]


@pytest.mark.parametrize("end", [".exr", ".mat"])
def test_the_stored_picture_agrees_in_silhouette(lamplit, end):
    stored = stored_picture(old("Test", "Automated", "Fixture", f"CoordinatesTest{end}", at=RTB4))
    assert stored.shape == lamplit.shape
    light = stored.sum(axis=2)
    # The skirts of its wide pixel filter, and what shines only by gloss, are as faint as this.
    assert_silhouettes_agree(lamplit.sum(axis=2) > 0, light > 0.05 * np.median(light[light > 0]))


@pytest.mark.parametrize("source", ["ours", "plain"])
def test_both_renderers_agree_in_silhouette(request, source):
    recipe = request.getfixturevalue(source)
    name = recipe.conditions.rows[0].name
    assert_silhouettes_agree(*(seen(recipe, each, name).sum(axis=2) > 0 for each in RENDERERS))


def mirrored(places):
    return {colour: tuple((WIDTH - x, y) for x, y in both) for colour, both in places.items()}


def assert_places(radiance, expected):
    """Segment a picture by colour, and compare where the objects are with where they should be."""
    others = np.abs(radiance / SKY - 1).max(axis=2) > 0.03
    bands = list(BRIGHTEST.values())
    colours = np.array(bands)[radiance[..., bands].argmax(axis=2)]
    for colour, places in expected.items():
        found = centres(others & (colours == BRIGHTEST[colour]))
        assert len(found) == 2, f"{len(found)} {colour} objects"
        for place in places:
            assert min(np.hypot(*(each - np.array(place))) for each in found) < 1, (
                f"{colour}: {found}, want {place}"
            )


def centres(mask):
    """Return the middles of what stands alone in a mask when two pixels are taken off all around."""
    labels, _ = ndimage.label(ndimage.binary_erosion(mask, SQUARE, iterations=2))
    boxes = [[(each.start + each.stop) / 2 for each in box] for box in ndimage.find_objects(labels)]
    large = np.bincount(labels.ravel())[1:] > 30
    return [np.array([x, y]) for (y, x), counts in zip(boxes, large, strict=True) if counts]


def assert_silhouettes_agree(ours, theirs):
    """Each mask lies inside the other with a pixel added all around, but for what is barely lit."""
    strays = ours & ~ndimage.binary_dilation(theirs, SQUARE) | theirs & ~ndimage.binary_dilation(ours, SQUARE)
    assert ours.sum() > 1500
    assert strays.sum() < 0.01 * ours.sum()


def stored_picture(file: Path):
    if file.suffix == ".mat":
        return io.loadmat(file)["multispectralImage"]
    return SpectralImage.load(file).radiance
