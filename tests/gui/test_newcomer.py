"""A newcomer's ten minutes in a real window, by mouse and keys alone, with a photograph of each step."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rtb_addon import SpectralImage

SCRIPT, WINDOW = "in_newcomer.py", True
STEPS = (
    "1-matte",
    "2-library",
    "2-blue",
    "3-light",
    "4-vary",
    "4-table",
    "5-patches",
    "5-rows",
    "6-preview",
    "7-filling",
    "7-rendered",
    "8-pointing",
    "8-compared",
    "9-stale",
    "9-rendered",
    "10-packed",
)
PATCHES = ["blue", "green", "red", "yellow", "magenta", "cyan"]


@pytest.mark.parametrize("step", STEPS)
def test_every_photograph_shows_something(shows, step):
    assert shows(f"newcomer-{step}")


def test_the_default_material_and_lamp_speak_in_spectra(report):
    model, reflectance = report["material"]
    assert model == "matte"
    assert reflectance.endswith("/blue")
    assert report["light"] == ["D65", 100.0]


def test_a_right_click_opens_the_table_and_marked_patches_are_its_rows(report):
    assert report["table opened"] == [True, "RenderToolbox"]
    assert [name for name, _ in report["rows"]] == PATCHES
    assert all(patch.endswith(f"/{name}") for name, patch in report["rows"])


def test_the_viewport_takes_the_colour_of_the_active_row(report):
    red, green, blue, _ = report["previewed"]
    assert red < green < blue, "cyan"


def test_all_six_are_rendered_and_then_the_changed_one_alone(report):
    assert report["states"] == ["done"] * 6
    patch, states = report["changed"]
    assert "skin" in patch
    assert states == ["done"] * 5 + ["changed"]
    assert report["rendered anew"] == ["cyan"]


def test_two_boxes_are_probed_and_compared(report):
    (blue, first, none), (green, second, compared) = report["pins"]
    assert blue.startswith("blue")
    assert green.startswith("green")
    assert (first, none, second, compared) == (1, 0, 2, 1)


def test_a_colleague_renders_the_same_cube_out_of_the_zip_without_blender(report, tmp_path):
    command = [sys.executable, "-m", "rtb_addon"]
    subprocess.run([*command, "unpack", report["packed"], str(tmp_path / "theirs")], check=True)
    subprocess.run([*command, "render", str(tmp_path / "theirs"), "--conditions", "blue"], check=True)
    ours, theirs = (
        SpectralImage.load(folder / "renderings/mitsuba/blue.exr").radiance
        for folder in (Path(report["saved"]).parent / "rtb/Untitled", tmp_path / "theirs")
    )
    assert ours.max() > 0
    assert np.array_equal(ours, theirs)
