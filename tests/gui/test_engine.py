"""RenderToolbox as a render engine in a real window: F12, and what ends it."""

from pathlib import Path

import pytest

SCRIPT, WINDOW = "in_engine.py", True
PHOTOGRAPHS = ("engine-render", "engine-material", "engine-light", "engine-result", "engine-rendering")


@pytest.fixture(scope="module")
def by_keys(blender, tmp_path_factory):
    """What was found out with a real keyboard."""
    folder = tmp_path_factory.mktemp("escape")
    places = folder / "report.json", str(folder / "home"), str(folder)
    return blender.run_script("in_escape.py", *places, window=True, simulated=False)


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_every_photograph_shows_something(shows, name):
    assert shows(name)


def test_f12_renders_the_active_condition_in_another_process_and_keeps_its_cube(report):
    job_runs, has_children = report["seen while rendering"]
    assert job_runs
    assert has_children
    assert report["cubes"] == ["green.exr"]
    red, green, blue = report["result"]
    assert green > 1.5 * red
    assert green > 1.5 * blue


def test_a_rendering_that_is_broken_off_leaves_no_process(report):
    assert report["stopped after"] < 5  # most of it is Blender's drawing, in software
    assert report["left"] == []


def test_blenders_command_line_renders_frames_and_keeps_their_cubes(blender, report):
    folder = Path(report["folder"])
    picture = ["-o", str(folder / "frame-####"), "-F", "PNG", "-f", "1..2"]
    finished = blender.run("-b", str(folder / "cube.blend"), "-E", "RENDERTOOLBOX", *picture)
    assert finished.returncode == 0, finished.stderr
    assert [file.name for file in sorted(folder.glob("frame-*"))] == ["frame-0001.png", "frame-0002.png"]
    kept = [file.relative_to(folder / "rtb/cube/still") for file in folder.rglob("renderings/tracer/*.exr")]
    assert {file.parts[0] for file in kept} == {"0001", "0002", "renderings"}


def test_esc_of_a_real_keyboard_ends_a_rendering_and_leaves_no_process(by_keys):
    assert by_keys["started"] == [True, True]
    assert by_keys["stopped after"] < 3
    assert by_keys["left"] == []
