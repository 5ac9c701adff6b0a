"""Ways to look at cubes, the grid they lie in, and the child that draws them."""

import base64
import json
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from rtb_addon.background import EventStream, close_input, send, start_child
from rtb_addon.colorimetry import xyz
from rtb_addon.errors import RecipeError
from rtb_addon.kept_cubes import KeptCubes
from rtb_addon.layers import Layers
from rtb_addon.montage import make_montage
from rtb_addon.recipe import Recipe
from rtb_addon.recipe.options import MontageOptions
from rtb_addon.spectra import Bands
from rtb_addon.spectral_image import SpectralImage
from rtb_addon.thumbnails import thumbnail
from rtb_addon.tiles import Tiles
from rtb_addon.viewer import Viewer
from rtb_addon.views import View, colours_of, false_colours, reduced

BANDS = Bands.regular(400, 50, 7)
NAMES = ("red", "green", "blue", "grey", "white")


def cube(seed: int, height: int = 4, width: int = 6) -> SpectralImage:
    radiance = np.random.default_rng(seed).random((height, width, len(BANDS)), np.float32)
    return SpectralImage(radiance, BANDS)


@pytest.fixture
def recipe(tmp_path):
    """A recipe of five conditions, all rendered but the third."""
    (tmp_path / "recipe.json").write_text('{"format": 1, "name": "chart", "renderer": "tracer"}')
    rows = "\n".join(["imageName", *NAMES])
    (tmp_path / "conditions.txt").write_text(rows + "\n")
    recipe = Recipe.load(tmp_path)
    for number, condition in enumerate(recipe.conditions):
        if number != 2:
            cube(number).save(recipe.rendering_file(condition))
    return recipe


def look(recipe: Recipe, **said) -> tuple[dict, np.ndarray]:
    """Let a viewer look at a recipe, and return its answer and its picture."""
    file = recipe.folder / "images/view.tif"
    request = {"verb": "look", "folder": str(recipe.folder), "output": str(file), **said}
    answer = Viewer().answer(json.loads(json.dumps(request)))
    assert "sentence" not in answer, answer
    return answer, np.asarray(Image.open(file))


def test_all_conditions_as_they_appear_are_the_montage(recipe):
    answer, picture = look(recipe)
    files = [recipe.rendering_file(condition) for condition in recipe.conditions]
    expected = make_montage([file if file.is_file() else None for file in files], recipe.montage)
    assert picture.tolist() == expected.tolist()
    assert answer["there"] == ["red", "green", "grey", "white"]


def test_one_condition_alone_fills_the_picture(recipe):
    answer, picture = look(recipe, condition="green")
    assert picture.shape == (4, 6, 3)
    assert Tiles.from_words(answer["tiles"]).names == ("green",)
    alone = MontageOptions(tone_map=recipe.montage.tone_map)
    assert picture.tolist() == make_montage([cube(1)], alone).tolist()


def test_white_at_a_luminance_shows_that_luminance_white():
    light = cube(0)
    white = 3 * xyz(light)[..., 1].max()
    pixels, full = View(full=white).drawn([View().of(light)], MontageOptions(tone_map=0))
    assert full == pytest.approx(white)
    expected = make_montage([light], MontageOptions(scale=1 / white, tone_map=0))
    assert pixels.tolist() == expected.tolist()


def test_a_band_is_the_one_that_is_nearest(recipe):
    view = View("wavelength", 561.0)
    assert view.of(cube(3))[..., 0].tolist() == cube(3).radiance[..., 3].tolist()
    answer, picture = look(recipe, view={"kind": "wavelength", "wavelength": 561.0}, condition="grey")
    assert answer["full"] == pytest.approx(cube(3).radiance[..., 3].max())
    assert (picture[..., 0] == picture[..., 2]).all()
    assert picture.max() == 255


def test_luminance_is_in_the_false_colours_of_its_scale(recipe):
    _, picture = look(recipe, view={"kind": "luminance", "full": 1000.0}, condition="red")
    share = np.clip(xyz(cube(0))[..., 1] / 1000, 0, 1)
    expected = false_colours()[np.rint(255 * share).astype(int)].astype(int)
    assert np.abs(picture - expected).max() <= 2  # single precision may fall on the next of 256 steps


def test_false_colours_grow_lighter_from_black_to_white():
    lightness = (false_colours() / 255.0) ** 2.2 @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(lightness) > -1e-3).all()
    assert lightness[0] == 0
    assert lightness[-1] == pytest.approx(1)


def test_a_difference_is_the_root_of_the_mean_square_over_the_bands(recipe):
    seen = View("difference").of(cube(1), cube(3))[..., 0]
    expected = np.sqrt(((cube(1).radiance - cube(3).radiance) ** 2).mean(axis=2))
    np.testing.assert_allclose(seen, expected, rtol=1e-5)
    answer, picture = look(recipe, view={"kind": "difference"}, other="grey", condition="grey")
    assert not picture.any()
    assert answer["full"] == 1


def with_errors(recipe: Recipe, name: str, level: float) -> None:
    """Write standard errors beside a condition's cube: a level in each band."""
    plane = np.full((4, 6, len(BANDS)), level, np.float32)
    Layers({"standard_error": plane}, BANDS).save(recipe.layers_file(recipe.conditions[name]))


def test_standard_errors_are_seen_where_there_are_some_and_missed_by_name(recipe):
    with_errors(recipe, "red", 0.5)
    with_errors(recipe, "white", 0.25)
    answer, picture = look(recipe, view={"kind": "error"})
    assert answer["there"] == ["red", "white"]
    missed = "no standard errors"
    assert answer["absent"] == {"green": missed, "blue": "not rendered", "grey": missed}
    assert answer["full"] == pytest.approx(0.5)
    tiles = Tiles.from_words(answer["tiles"])
    for number, share in ((0, 1.0), (4, 0.5), (1, 0.0)):
        left, top = tiles.corner(number)
        assert picture[top, left].tolist() == false_colours()[round(255 * share)].tolist()


def test_standard_errors_that_are_rendered_anew_are_looked_at_anew(recipe):
    viewer = Viewer()
    request = {"verb": "look", "folder": str(recipe.folder), "condition": "red"}
    request |= {"output": str(recipe.folder / "view.tif"), "view": {"kind": "error"}}
    assert "Layers" in viewer.answer(request)["sentence"]
    for level in (0.5, 0.125):
        with_errors(recipe, "red", level)
        assert viewer.answer(request)["full"] == pytest.approx(level)


def test_what_was_rendered_in_another_size_before_waits_for_its_turn(recipe):
    newest = recipe.rendering_file(recipe.conditions["grey"])
    cube(3, height=8, width=12).save(newest)
    answer, picture = look(recipe)
    assert answer["there"] == ["grey"]
    assert answer["absent"] == dict.fromkeys(("red", "green", "white"), "of another size") | {
        "blue": "not rendered"
    }
    tiles = Tiles.from_words(answer["tiles"])
    left, top = tiles.corner(NAMES.index("grey"))
    assert picture[top : top + 8, left : left + 12].any(axis=2).all()
    assert picture.any(axis=2).sum() == 8 * 12


def test_a_grid_that_is_asked_for_goes_before_the_recipes(recipe):
    answer, picture = look(recipe, grid={"columns": 2, "fill": "rows"})
    tiles = Tiles.from_words(answer["tiles"])
    assert (tiles.rows, tiles.columns, tiles.fill) == (3, 2, "rows")
    assert picture.shape == (3 * 4, 2 * 6, 3)


def test_the_colours_of_a_scale_are_those_of_the_picture(recipe):
    ramp = SpectralImage(np.tile(np.linspace(0, 1, 256, dtype=np.float32)[None, :, None], (1, 1, 7)), BANDS)
    for kind in ("wavelength", "luminance"):
        view = View(kind)
        pixels, _ = view.drawn([view.of(ramp)], MontageOptions())
        assert (
            np.abs(pixels[0].astype(int) - colours_of(kind)).max() <= 3
        )  # a step of 256 in single precision


@pytest.mark.parametrize(
    ("said", "sentence"),
    [
        ({"condition": "blue"}, "blue is not rendered yet"),
        ({"condition": "gone"}, "no condition gone"),
        ({"view": {"kind": "difference"}}, "another condition"),
        ({"view": {"kind": "difference"}, "other": "blue"}, "blue is not rendered yet"),
    ],
)
def test_what_cannot_be_shown_is_said_in_one_sentence(recipe, said, sentence):
    request = {"verb": "look", "folder": str(recipe.folder), "output": "nowhere.tif", **said}
    assert sentence in Viewer().answer(request)["sentence"]


def test_cubes_of_other_sizes_have_no_difference():
    with pytest.raises(RecipeError, match="cannot be compared"):
        View("difference").of(cube(1), cube(1, height=5))


@pytest.mark.parametrize("fill", ["rows", "columns"])
@pytest.mark.parametrize("by", [1, 2])
def test_every_pixel_of_a_montage_is_found_again(fill, by):
    tiles = Tiles.of(NAMES, (6, 4), MontageOptions(columns=2, fill=fill), by)
    assert Tiles.from_words(json.loads(json.dumps(tiles.to_words()))) == tiles
    for number, name in enumerate(NAMES):
        left, top = tiles.corner(number)
        for column, row in ((0, 0), (6 // by - 1, 4 // by - 1)):
            place = left + column + 0.25, top + row + 0.25
            assert tiles.at(*place) == (name, int((column + 0.25) * by), int((row + 0.25) * by))
        assert tiles.at(left, top) == (name, 0, 0)
    width, height = tiles.size
    assert tiles.at(width + 1, 0) is tiles.at(0, height + 1) is tiles.at(-0.5, 0) is None
    assert tiles.at(width - 1, height - 1) is None  # the sixth cell is empty


def test_a_reduced_picture_holds_means():
    seen = np.arange(2 * 5 * 4, dtype=np.float32).reshape(5, 4, 2)
    assert reduced(seen, 1) is seen
    assert reduced(seen, 2).shape == (2, 2, 2)
    np.testing.assert_allclose(reduced(seen, 2)[0, 0], seen[:2, :2].mean(axis=(0, 1)))


def test_an_edited_cube_is_looked_at_anew(recipe):
    viewer = Viewer()
    request = {"verb": "look", "folder": str(recipe.folder), "condition": "red"}
    request |= {"output": str(recipe.folder / "view.tif"), "view": {"kind": "luminance"}}
    before = viewer.answer(request)["full"]
    file = recipe.rendering_file(recipe.conditions["red"])
    cube(0).scaled(2).save(file)
    assert viewer.answer(request)["full"] == pytest.approx(2 * before)


@pytest.mark.parametrize(("height", "width"), [(4, 6), (96, 64), (9, 100)])
def test_a_small_picture_keeps_the_shape_of_a_cube_and_is_as_bright_as_can_be(height, width):
    flat = SpectralImage(np.full((height, width, len(BANDS)), 0.003, np.float32), BANDS)
    picture = thumbnail(flat, 32)
    there = picture[..., 3] == 255
    rows, columns = np.flatnonzero(there.any(axis=1)), np.flatnonzero(there.any(axis=0))
    assert picture.shape == (32, 32, 4)
    assert len(rows) / len(columns) == pytest.approx(height / width, abs=0.5 / len(columns))
    assert max(len(rows), len(columns)) == min(32, max(height, width))
    assert there.sum() == len(rows) * len(columns)
    assert picture[~there].max(initial=0) == 0
    assert picture[there][:, :3].max() == 255


def test_small_pictures_of_what_is_rendered_come_from_the_lowest_row_up(recipe):
    request = {"verb": "thumbnails", "folder": str(recipe.folder), "names": [*NAMES, "gone"], "side": 8}
    pictures = Viewer().answer(request)["pictures"]
    assert sorted(pictures) == sorted({*NAMES} - {"blue"})
    came = np.frombuffer(base64.b64decode(pictures["red"]), np.uint8).reshape(8, 8, 4)
    np.testing.assert_array_equal(came[::-1], thumbnail(cube(0), 8))


def test_no_more_cubes_are_kept_than_memory_is_given(recipe, monkeypatch):
    size = cube(0).radiance.nbytes
    monkeypatch.setattr("rtb_addon.kept_cubes.MEMORY", 2 * size)
    kept = KeptCubes()
    files = [recipe.rendering_file(recipe.conditions[name]) for name in ("red", "green", "grey")]
    first = [kept.cube(file) for file in files]
    assert kept.cube(files[2]) is first[2]
    assert kept.cube(files[1]) is first[1]
    again = kept.cube(files[0])  # the one that was looked at longest ago had to go
    assert again is not first[0]
    assert kept.cube(files[1]) is first[1]
    assert kept.cube(files[2]) is not first[2]


def test_a_developed_cube_is_its_colours_from_the_lowest_row_up(recipe, tmp_path):
    matrix = [[0, 1, 0], [0, 0, 2], [1, 0, 0]]
    file = recipe.rendering_file(recipe.conditions["red"])
    request = {"verb": "develop", "cube": str(file), "matrix": matrix, "output": str(tmp_path / "pixels")}
    assert Viewer().answer(request) == {"verb": "develop", "width": 6, "height": 4}
    pixels = np.fromfile(tmp_path / "pixels", np.float32).reshape(4, 6, 4)
    x, y, z = np.moveaxis(xyz(cube(0)), 2, 0)
    np.testing.assert_allclose(pixels[::-1], np.stack([y, 2 * z, x, np.ones_like(x)], 2), rtol=1e-6)


def test_a_viewer_answers_in_a_process_of_its_own_and_ends_with_its_input(recipe):
    child = start_child([], module="rtb_addon.viewer", threads=1)
    stream = EventStream(child, parse=json.loads)
    request = {"folder": str(recipe.folder), "renderer": "", "condition": "red", "region": [1, 2, 3, 1]}
    assert send(child, json.dumps({"verb": "probe", **request}))
    answer = stream.inbox.get(timeout=30)[1]
    assert answer["probe"]["radiance"] == pytest.approx(cube(0).radiance[2, 1:4].mean(axis=0).tolist())
    close_input(child)
    assert child.wait(timeout=5) == 0
    assert stream.inbox.get(timeout=5)[1] is None


def test_views_differ_by_their_unit():
    assert View().unit == "cd m-2"
    assert replace(View(), kind="wavelength").unit == "W sr-1 m-2 nm-1"
