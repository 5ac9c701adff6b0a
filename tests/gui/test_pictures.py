"""The Image Editor in a real window: a montage that fills, ways to look at renderings, the spectrum probe."""

import csv
import io

import numpy as np
import pytest

SCRIPT = "in_pictures.py"
WINDOW = True
PHOTOGRAPHS = (
    "montage-filling",
    "rendering-panel",
    *("view-wavelength", "view-luminance", "view-difference"),
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
    assert [views[kind][0] for kind in ("wavelength", "luminance", "difference")] == ["", "", ""]
    red, green, blue = views["wavelength"][2]
    assert red == green == blue > 0
    assert len({*map(tuple, (views[kind][2] for kind in ("wavelength", "luminance", "difference")))}) == 3
    assert 1 < views["luminance"][1] < 1000
    assert views["scale taken over"][0] == pytest.approx(views["scale taken over"][1])


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


def test_what_is_copied_and_what_is_written_hold_the_same_spectra(report):
    assert report["file"] == report["clipboard"]
    rows = {row[0]: row[1:] for row in csv.reader(io.StringIO(report["file"]))}
    assert rows["condition"] == ["blue", "", "red", ""]
    spectra = np.array([rows[f"{nm}"] for nm in range(400, 701, 10)], float)
    assert (spectra >= 0).all()
    assert spectra[:, 0].argmax() < 10 < 20 < spectra[:, 2].argmax()  # blue light is short, red long
