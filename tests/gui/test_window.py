"""A whole experiment in a real window, by simulated mouse and keys; photographs stay in build/screenshots."""

import time
from pathlib import Path

import pytest

SCRIPT = "in_window.py"
WINDOW = True
PANELS = (
    "material-untagged",
    "material",
    "light",
    "world",
    "recipe",
    "rendering",
    "montage",
    "montage-beside",
    "error",
)


@pytest.mark.parametrize("name", PANELS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_use_spectra_takes_the_materials_own_colour(report):
    used, reflectance = report["use spectra pressed"]
    assert used
    assert reflectance


def test_a_click_renders_in_another_process_and_shows_the_montage(report):
    assert report["started by click"]
    assert report["child"]
    assert report["errors after rendering"] == []
    name, size = report["montage"]
    assert name == "cube"
    assert size == [3 * 80, 2 * 60]


def test_show_montage_opens_an_image_editor_where_there_is_none(report):
    none_before, name = report["montage beside"]
    assert none_before
    assert name == "cube"


def test_blender_stays_usable_while_a_batch_renders(report):
    assert report["longest of ours"]["take"] < 0.05
    assert report["longest of ours"]["draw"] < 0.05
    # How long Blender itself takes to draw in software is the machine's affair. Beside renderers that take
    # every core it takes longer, but its main loop comes round as often as it draws.
    assert report["rendering"]["longest"] < 5 * report["drawing"]["longest"]


def test_blenders_own_process_stays_free_of_what_renderers_need(report):
    assert report["heavy modules"] == []


@pytest.mark.parametrize("how", ["Esc over VIEW_3D", "Esc over IMAGE_EDITOR", "Cancel button"])
def test_a_batch_stops_within_a_second(report, how):
    assert report["stopped"][how] < 1.0
    assert report["left"][how] == []


def test_undo_does_not_touch_what_is_being_rendered(report):
    assert report["undo leaves the batch alone"]


@pytest.mark.parametrize("how", ["opening a file", "disabling"])
def test_no_process_is_left_when_the_batchs_file_or_the_extension_goes(report, how):
    assert report["left"][how] == []


def test_disabling_ends_the_reading_of_a_scene(report):
    assert report["read while disabling"] == [True, False]


def test_no_finished_cube_is_lost_when_batches_are_stopped(report):
    count, kept = report["cubes kept"]
    assert count == 6
    assert kept


def test_quitting_blender_leaves_no_process(report):
    running = report["when quitting"]
    assert running
    deadline = time.monotonic() + 2
    while (left := [pid for pid in running if _alive(pid)]) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert left == []


def test_what_is_wrong_is_said_in_one_sentence(report):
    assert "camera" in report["refused"]


def _alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False
    return state != "Z"
