"""Montages: the grid, what stands where, what all cells share, and what cannot be shown."""

import time

import numpy as np
import pytest
from PIL import Image

from rtb_addon.batch import render_recipe
from rtb_addon.colorimetry import linear_srgb, srgb8, tone_mapped, xyz
from rtb_addon.errors import RecipeError
from rtb_addon.montage import grid, make_montage, write_png
from rtb_addon.pictures import with_montages
from rtb_addon.recipe.options import MontageOptions
from rtb_addon.spectra import DEFAULT_BANDS, library
from rtb_addon.spectral_image import SpectralImage

LIGHT = library.find("D65").at(DEFAULT_BANDS.centres)
BY_ROWS = MontageOptions(columns=6, fill="rows", tone_map=0)


def plain(level, height=3, width=2):
    return SpectralImage(np.tile(np.float32(level * LIGHT), (height, width, 1)), DEFAULT_BANDS)


def cells(picture, rows, columns):
    height, width = picture.shape[0] // rows, picture.shape[1] // columns
    return picture.reshape(rows, height, columns, width, 3)[:, 0, :, 0]


@pytest.mark.parametrize(
    ("count", "expected"),
    [(1, (1, 1)), (2, (1, 2)), (3, (1, 3)), (4, (2, 2)), (5, (2, 3)), (6, (2, 3)), (8, (2, 4)), (24, (4, 6))],
)
def test_the_grid_is_rendertoolbox3s_unless_columns_are_given(count, expected):
    assert grid(count, MontageOptions()) == expected
    assert grid(count, MontageOptions(columns=2)) == (-(-count // 2), 2)


def test_cells_go_down_the_columns_and_empty_ones_are_black():
    picture = make_montage([plain(level) for level in (1, 2, 3, 4, 5)], MontageOptions(tone_map=0))
    assert (picture.shape, picture.dtype) == ((6, 6, 3), np.uint8)
    green = cells(picture, 2, 3)[..., 1]
    assert green[0, 0] < green[1, 0] < green[0, 1] < green[1, 1] < green[0, 2]
    assert cells(picture, 2, 3)[1, 2].tolist() == [0, 0, 0]


def test_a_chart_fills_its_rows():
    picture = make_montage((plain(1 + number) for number in range(24)), BY_ROWS)
    green = cells(picture, 4, 6)[..., 1].astype(int).ravel()
    assert (np.diff(green) > 0).all()


def test_all_cells_share_one_tone_map_and_one_scale():
    images = [plain(level) for level in (1, 3, 90)]
    picture = make_montage(images, MontageOptions(tone_map=2))
    together = np.concatenate([xyz(image) for image in images], axis=1)
    limit = 2 * together[..., 1].mean()
    linear = linear_srgb(tone_mapped(together, 2))
    expected = srgb8(
        np.concatenate([xyz(plain(1)), xyz(plain(3)), xyz(plain(limit / xyz(plain(1))[0, 0, 1]))], 1)
    )
    assert linear.max() < linear_srgb(together).max()
    assert abs(picture.astype(int) - expected).max() <= 1


def test_empty_cells_count_in_the_mean_luminance():
    dim = MontageOptions(tone_map=1, scale=1e-8)
    images = [plain(level) for level in (1, 1, 1, 1, 20)]
    brightest_of_five = make_montage(images, dim).max()
    brightest_of_six = make_montage([*images, plain(1)], dim).max()
    assert brightest_of_five < brightest_of_six


def test_a_given_scale_is_used_as_it_is():
    image = plain(1)
    picture = make_montage([image], MontageOptions(tone_map=0, scale=5e-8))
    assert abs(picture.astype(int) - srgb8(xyz(image), 5e-8)).max() <= 1
    assert 0 < picture.max() < 255


def test_later_images_are_cropped_to_the_first():
    wide = make_montage([plain(1), plain(1, 5, 4)], MontageOptions(tone_map=0))
    assert wide.shape == (3, 4, 3)
    assert (wide == wide[0, 0]).all()


def test_cubes_are_read_from_their_files_one_at_a_time(tmp_path):
    paths = [tmp_path / f"{number}.exr" for number in range(3)]
    for number, path in enumerate(paths):
        plain(number + 1).save(path)

    def one_after_the_other():
        for path in paths:
            yield path
            path.unlink()  # nobody needs it any more

    picture = make_montage(one_after_the_other())
    np.testing.assert_array_equal(picture, make_montage([plain(1), plain(2), plain(3)]))


def test_cells_that_are_not_rendered_yet_are_black():
    picture = make_montage([None, plain(1), None], MontageOptions(tone_map=0))
    assert cells(picture, 1, 3)[0, :, 1].tolist() == [0, picture.max(), 0]


def test_a_montage_without_light_is_black():
    assert make_montage([plain(0), plain(0)]).max() == 0


def test_the_chart_looks_like_the_chart():
    paints = [library.find(name).at(DEFAULT_BANDS.centres) for name in library.patches()]
    images = [
        SpectralImage((paint * LIGHT).astype(np.float32).reshape(1, 1, 31), DEFAULT_BANDS) for paint in paints
    ]
    picture = make_montage(images, BY_ROWS).astype(int)
    red, green, blue = (picture[2, column] for column in (2, 1, 0))
    assert red.argmax() == 0
    assert green.argmax() == 1
    assert blue.argmax() == 2
    greys = picture[3]
    assert (np.diff(greys.mean(axis=1)) < 0).all()
    assert np.ptp(greys, axis=1).max() < 12


@pytest.mark.parametrize("images", [[], [None, None]])
def test_nothing_to_show_is_one_sentence(images):
    with pytest.raises(RecipeError, match="no renderings to show, render some conditions first"):
        make_montage(images)


def test_a_missing_cube_is_one_sentence(tmp_path):
    with pytest.raises(RecipeError, match=r"there is no file .*gone\.exr"):
        make_montage([plain(1), tmp_path / "gone.exr"])


def test_a_smaller_image_is_one_sentence():
    with pytest.raises(
        RecipeError, match=r"image 2 is 2 x 2 pixels, a montage needs all at least 2 x 3 like"
    ):
        make_montage([plain(1), plain(1, 2, 2)])


def test_a_picture_survives_its_png(tmp_path):
    picture = np.random.default_rng(1).integers(0, 256, (5, 7, 3), np.uint8)
    write_png(tmp_path / "images" / "montage.png", picture)
    with Image.open(tmp_path / "images" / "montage.png") as stored:
        np.testing.assert_array_equal(np.asarray(stored), picture)
    assert [path.name for path in (tmp_path / "images").iterdir()] == ["montage.png"]


def test_the_montage_is_painted_while_the_workers_still_end(write_family):
    recipe = write_family({"light": "0.8", "dark": "0.2"})
    picture = recipe.montage_file("plain")

    def slow_to_end():
        for event in render_recipe(recipe.folder, jobs=1):
            end = time.monotonic() + 20
            while event.kind == "finished" and not picture.is_file():
                assert time.monotonic() < end, "nobody painted it meanwhile"
                time.sleep(0.01)
            yield event

    *_, last = with_montages(recipe, slow_to_end())
    assert (last.kind, last.file) == ("finished", str(picture))
