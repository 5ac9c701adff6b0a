"""``blender --command rtb``: every verb of the command line, with the installed zip and nothing else."""

import subprocess
import sys
import zipfile
from typing import NamedTuple

import pytest

from tests.gui.conftest import ROOT

NAMES = ("dark, wet", "white")


class Said(NamedTuple):
    """How a command ended."""

    status: int
    output: str
    complaints: str


@pytest.fixture
def command(blender, tmp_path):
    """Return how to run a command in a folder of its own; no command ever shows a traceback."""

    def run(*words) -> Said:
        ended = subprocess.run(
            [str(blender.program), "--command", "rtb", *map(str, words)],
            cwd=tmp_path,
            env=blender.environment,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )
        assert "Traceback" not in ended.stderr, ended.stderr
        return Said(ended.returncode, ended.stdout, ended.stderr)

    return run


@pytest.fixture
def square(tmp_path):
    """A recipe's folder, made from Python: two of SimpleSquare's conditions, a comma in the name of one."""
    folder = tmp_path / "square"
    script = ROOT / "examples/simple_square/make_recipe.py"
    subprocess.run([sys.executable, str(script), str(folder)], check=True, capture_output=True)
    table = folder / "conditions.txt"
    head, first, second, *_ = table.read_text().splitlines()
    rows = [f"{name}\t{row.partition(chr(9))[2]}" for name, row in zip(NAMES, (first, second), strict=True)]
    table.write_text("\n".join([head, *rows]) + "\n")
    return folder


def test_a_recipe_is_checked_rendered_looked_at_compared_and_packed(command, square, tmp_path):
    assert command("check", square).status == 0
    few = ("--size", "8x6", "--samples", "2")
    alone = command("render", square, *few, "--renderer", "tracer", "--conditions", '"dark, wet"')
    assert alone.status == 0
    assert "1 rendered, 0 found done, 0 failed" in alone.output
    assert "1 rendered, 1 found done" in command("render", square, *few, "--renderer", "tracer").output
    events = command("render", square, *few, "--renderer", "mitsuba", "--json")
    assert events.status == 0
    assert events.output.splitlines()[-1].startswith('{"kind": "finished"')
    picture = command("montage", square, "--renderer", "tracer", "--output", tmp_path / "square.png")
    assert picture.output.strip() == str(tmp_path / "square.png")
    compared = command("compare", square, "--renderers", "mitsuba,tracer")
    assert {row.split("\t")[0] for row in compared.output.splitlines()[1:]} == set(NAMES)
    assert (compared.status, compared.complaints) == (0, "")
    assert command("pack", square, "square.zip", "--renderings").status == 0
    assert "recipe.json" in zipfile.ZipFile(tmp_path / "square.zip").namelist()
    assert command("unpack", "square.zip", "elsewhere").status == 0
    assert "0 rendered, 2 found done" in command("render", "elsewhere", *few, "--renderer", "tracer").output
    old = [square / name for name in ("parent.dae", "conditions.txt", "mappings.txt")]
    assert command("import", *old, "--output", "imported").status == 0
    assert (tmp_path / "imported/recipe.json").is_file()


def test_every_renderer_is_found(command):
    said = command("renderers")
    assert said.status == 0
    assert [line.split()[0] for line in said.output.splitlines()] == ["mitsuba", "sphere", "tracer"]
    assert "missing" not in said.output


@pytest.mark.parametrize(
    ("words", "status", "says"),
    [
        (["check", "nowhere"], 2, "nowhere is no recipe folder: it holds no recipe.json"),
        (["paint"], 2, "usage: blender --command rtb "),
        (["render", "square", "--conditions", "black"], 2, "no condition is called black, there are"),
    ],
)
def test_what_is_wrong_is_said_in_words(command, square, words, status, says):
    said = command(*words)
    assert (said.status, said.output) == (status, "")
    assert said.complaints.startswith(says)


def test_help_says_how_blender_is_told(command):
    said = command("render", "--help")
    assert said.status == 0
    assert said.output.startswith("usage: blender --command rtb render ")
