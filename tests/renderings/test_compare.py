"""The command that holds one renderer's cubes against another's, on real renderings."""

import json

import numpy as np

from rtb_addon.__main__ import main
from rtb_addon.spectral_image import SpectralImage


def test_mitsuba_and_the_tracer_are_compared_from_the_command_line(write_family, capsys):
    recipe = write_family({"light": "0.8", "dark": "400:0.1 700:0.4"}, width=12, height=9, samples=64)
    folder = str(recipe.folder)
    for renderer in ("mitsuba", "tracer"):
        assert main(["render", folder, "--renderer", renderer, "--jobs", "1", "--json"]) == 0
    capsys.readouterr()
    assert main(["compare", folder, "--renderers", "tracer,mitsuba", "--json"]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["condition"] for line in lines] == ["light", "dark"]
    # A flat square under a point lamp is seen without noise but for where in the pixels the paths begin.
    assert all(abs(float(line["ratio"]) - 1) < 2e-3 for line in lines)
    made = recipe.folder / "comparisons" / "tracer-mitsuba"
    assert sorted(file.name for file in made.iterdir()) == [
        "dark.exr",
        "family.png",
        "light.exr",
        "numbers.txt",
    ]
    cubes = [
        SpectralImage.load(recipe.folder / "renderings" / name / "dark.exr").radiance
        for name in ("tracer", "mitsuba")
    ]
    difference = SpectralImage.load(made / "dark.exr")
    np.testing.assert_allclose(difference.radiance, cubes[0] - cubes[1], rtol=1e-5, atol=1e-7)
    assert difference.attributes["difference"] == "tracer minus mitsuba"
    assert main(["compare", folder, "--renderers", "tracer,mitsuba"]) == 0
    assert capsys.readouterr().out.startswith("condition\tratio")
