"""The Image Editor in a real window: a montage that fills, ways to look at renderings, the spectrum probe."""

import csv
import io
import warnings
from typing import NamedTuple

import numpy as np
import OpenEXR
import pytest

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import colour

SCRIPT = "in_pictures.py"
WINDOW = True
PHOTOGRAPHS = (
    "montage-filling",
    "rendering-panel",
    *("view-wavelength", "view-luminance", "view-difference", "view-error"),
    *("probe-hovering", "probe-box", "probe", "probe-panel"),
)


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_the_montage_opens_beside_the_viewport_and_fills_while_the_batch_runs(report):
    assert not report["image editors before"]
    assert report["errors"] == []
    assert report["filled"][0] < 6
    assert len(set(report["filled"])) >= 3
    assert report["filled"][-1] == 6
    name, size, has_unsaved_pixels = report["shown"]
    assert (name, size, has_unsaved_pixels) == ("cube", [3 * 160, 2 * 120], False)


def test_blenders_main_thread_is_never_held_up(report):
    assert max(report["longest"].values()) < 0.05
    assert report["heavy modules"] == []


def test_every_view_shows_what_it_says(report):
    views = report["views"]
    assert [views[kind][0] for kind in ("wavelength", "luminance", "difference", "error")] == [""] * 4
    assert 0 < views["error"][1] < views["difference"][1]
    red, green, blue = views["wavelength"][2]
    assert red == green == blue > 0
    assert len({*map(tuple, (views[kind][2] for kind in ("wavelength", "luminance", "difference")))}) == 3
    assert 1 < views["luminance"][1] < 1000
    assert views["scale taken over"][0] == pytest.approx(views["scale taken over"][1])


def test_the_slider_of_wavelengths_is_dragged_and_the_picture_follows(report):
    (before, dark), (after, light) = report["slid"]
    assert before == 550
    assert after > before + 5
    assert dark != light


def test_undo_takes_back_what_was_moved_and_leaves_the_montage(report):
    height, shown = report["after undo"]
    assert height == 0
    assert shown == ["cube", [3 * 160, 2 * 120]]


def test_names_stand_on_the_tiles_until_overlays_are_hidden(report):
    shown, hidden = report["bright pixels of a name"]
    assert shown > 20
    assert hidden == 0


def test_one_condition_fills_the_picture_and_an_unknown_one_is_said(report):
    sentence, size, (red, green, blue) = report["views"]["blue"]
    assert (sentence, size) == ("", [160, 120])
    assert blue > 2 * green > 2 * red
    assert "no condition nobody" in report["views"]["nobody"]


def test_the_pointer_shows_the_pixel_below_it_and_nothing_beside_the_picture(report):
    condition, (column, row, width, height), luminance = report["hovered"]
    assert condition == "blue"
    assert abs(column - 80) <= 2
    assert abs(row - 60) <= 2
    assert (width, height) == (1, 1)
    assert luminance > 0
    assert report["off the picture"]


def test_a_second_box_with_shift_is_compared_to_the_first(report):
    (first, one, alone), (second, two, compared) = report["pins"]
    assert first.startswith("blue")
    assert second.startswith("red")
    assert (one, alone, two, compared) == (1, 0, 2, 1)
    delta_e, (long, _, short) = report["difference"]
    assert delta_e > 20
    assert long > 0 > short


def test_the_tool_is_chosen_by_its_icon(report):
    assert report["tool"] == "rtb.probe_tool"


def test_what_is_copied_and_what_is_written_hold_the_same_spectra(report):
    assert report["file"] == report["clipboard"]
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(report["file"]))}
    assert rows["condition"] == ["blue", "", "red", ""]
    spectra = np.array([rows[f"{nm}"] for nm in range(400, 701, 10)], float)
    assert (spectra >= 0).all()
    assert spectra[:, 0].argmax() < 10 < 20 < spectra[:, 2].argmax()  # blue light is short, red long


def test_the_numbers_are_those_that_colour_science_finds_in_the_cubes(report):
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(report["clipboard"]))}
    found = [in_cube(report, rows, place) for place in (0, 2)]
    white = found[0].brightest
    for place, each in zip((0, 2), found, strict=True):
        bands = [rows[f"{nm}"] for nm in range(400, 701, 10)]
        np.testing.assert_allclose([float(band[place]) for band in bands], each.mean, rtol=1e-6)
        np.testing.assert_allclose([float(band[place + 1]) for band in bands], each.error, rtol=1e-2)
        assert float(rows["luminance [cd m-2]"][place]) == pytest.approx(each.xyz[1], rel=1e-5)
        assert float(rows["x"][place]) == pytest.approx(each.xyz[0] / each.xyz.sum(), abs=1e-5)
        assert float(rows["y"][place]) == pytest.approx(each.xyz[1] / each.xyz.sum(), abs=1e-5)
    contrast = found[1].lms / found[0].lms - 1
    told = [float(rows[f"{cone} contrast to the first"][2]) for cone in "LMS"]
    np.testing.assert_allclose(told, contrast, atol=1e-5)
    lab = [colour.XYZ_to_Lab(each.xyz / white, np.array((0.3127, 0.3290))) for each in found]
    delta_e = next(values for heading, values in rows.items() if heading.startswith("delta E 2000"))
    assert float(delta_e[2]) == pytest.approx(colour.delta_E(*lab, method="CIE 2000"), abs=1e-4)


class InCube(NamedTuple):
    """What a region of a cube comes to."""

    mean: np.ndarray
    error: np.ndarray
    xyz: np.ndarray
    lms: np.ndarray
    brightest: float


def in_cube(report, rows, place: int) -> InCube:
    """Return what lies in the region of a pin, by OpenEXR's own reader and colour-science's tables."""
    channels = OpenEXR.File(f"{report['cubes']}/{rows['condition'][place]}.exr").channels()
    planes = [channels[f"S0.{nm},000000nm"].pixels.astype(float) for nm in range(400, 701, 10)]
    cube = np.stack(planes, axis=2)
    left, top, width, height = map(int, rows["region [left top width height]"][place].split())
    pixels = cube[top : top + height, left : left + width].reshape(-1, 31)
    mean, error = pixels.mean(axis=0), pixels.std(axis=0, ddof=1) / np.sqrt(len(pixels))
    observer = weights("CIE 1931 2 Degree Standard Observer")
    cones = weights("Stockman & Sharpe 2 Degree Cone Fundamentals")
    brightest = 683 * (cube @ observer[:, 1]).max()
    return InCube(mean, error, 683 * mean @ observer, mean @ cones, brightest)


def weights(name: str) -> np.ndarray:
    """Return what a band of 10 nm counts for, (bands, 3) [nm]: 10 times a table at its centre."""
    table = colour.MSDS_CMFS[name]
    found = dict(zip(table.wavelengths.astype(int), table.values, strict=True))
    return 10 * np.array([found[nm] for nm in range(400, 701, 10)])
