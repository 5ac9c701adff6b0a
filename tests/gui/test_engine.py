"""RenderToolbox as a render engine in a real window: F12, and the button that ends it."""

from pathlib import Path

import pytest

PICTURES = Path(__file__).resolve().parents[2] / "build/screenshots"
PHOTOGRAPHS = ("engine-render", "engine-material", "engine-light", "engine-result", "engine-rendering")


@pytest.fixture(scope="module")
def report(blender, tmp_path_factory):
    """What was found out in the window."""
    folder = tmp_path_factory.mktemp("engine")
    return blender.run_script(
        "in_engine.py", folder / "report.json", str(folder / "home"), str(PICTURES), window=True
    )


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_every_photograph_shows_something(report, name):
    assert (PICTURES / f"{name}.png").is_file()
    assert report["colours"][name] > 500


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
