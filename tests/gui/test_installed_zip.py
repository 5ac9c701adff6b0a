"""The zip, installed into a real Blender, renders there without a window."""

import pytest

SCRIPT = "in_background.py"


def test_the_zip_installs_and_is_enabled(report):
    assert report["enabled"]


@pytest.mark.parametrize("renderer", ["tracer", "mitsuba"])
def test_an_installed_extension_renders_with_what_its_zip_brought(report, renderer):
    assert report[renderer] == "FINISHED"
    cubes = [file for file in report["files"] if f"renderings/{renderer}/" in file and file.endswith(".exr")]
    assert sorted(cube.rsplit("/", 1)[1] for cube in cubes) == ["blue.exr", "green.exr"]


def test_the_montage_is_an_image_of_blenders(report):
    assert list(report["images"].values()) == [[64, 24]] * len(report["images"])
    assert report["images"]


def test_an_error_is_one_sentence_that_scripts_can_catch(report):
    assert "camera" in report["without camera"]
    assert "Traceback" not in report["without camera"]
    assert len(report["without camera"].splitlines()) == 1


def test_blenders_own_process_stays_free_of_what_renderers_need(report):
    assert report["heavy modules"] == []
