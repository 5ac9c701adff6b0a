"""What README and docs tell people to type works."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

import rtb_addon
from rtb_addon.conditions import parse_conditions
from rtb_addon.mappings import parse_mappings
from rtb_addon.spectra.donaldson import read_donaldson

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.M | re.S)


def blocks(language: str):
    """What needs Blender is run in tests/blender."""
    return [
        pytest.param(text, id=f"{page.name}-{at}")
        for page in PAGES
        for at, (kind, text) in enumerate(BLOCK.findall(page.read_text()))
        if kind == language and "import bpy" not in text
    ]


def commands():
    lines = {
        line.split("#")[0].strip()
        for page in PAGES
        for kind, text in BLOCK.findall(page.read_text())
        if kind == "sh"
        for line in text.splitlines()
    }
    return sorted(lines - {""})


@pytest.mark.parametrize("code", blocks("python"))
def test_python_in_the_docs_runs(code, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "docs", "exec"), {"__name__": "docs"})


@pytest.mark.parametrize("line", [line for line in commands() if line.startswith("make")])
def test_make_knows_the_targets_that_the_docs_name(line):
    done = subprocess.run(["make", "--dry-run", *line.split()[1:]], cwd=ROOT, capture_output=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("line", [line for line in commands() if "-m rtb_addon" in line])
def test_the_command_line_knows_the_commands_that_the_docs_name(line):
    command = line.split("-m rtb_addon")[1].split()[0]
    done = subprocess.run(
        [sys.executable, "-m", "rtb_addon", command, "--help"], cwd=ROOT, capture_output=True
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_between_pages_lead_somewhere(page):
    targets = re.findall(r"\]\((?!https?:)([^)#]+)", page.read_text())
    assert not [target for target in targets if not (page.parent / target).exists()]


def test_every_decision_is_listed():
    folder = ROOT / "docs" / "decisions"
    listed = re.findall(r"\]\((.+?\.md)\)", (folder / "README.md").read_text())
    assert sorted([*listed, "README.md"]) == sorted(page.name for page in folder.glob("*.md"))


def test_tables_mappings_and_matrices_in_the_docs_are_read(tmp_path):
    kinds = {"imageName": parse_conditions, "Collada {": parse_mappings, "[ {": parse_mappings}
    found = [text for page in PAGES for kind, text in BLOCK.findall(page.read_text()) if kind in ("", "json")]
    told = {start: [text for text in found if text.startswith(start)] for start in kinds}
    assert all(told.values())
    for start, texts in told.items():
        for text in texts:
            kinds[start](text, "docs", *(["family"] if start == "imageName" else []))
    (tmp_path / "matrix.txt").write_text(next(text for text in found if re.match(r" +300 +350", text)))
    assert read_donaldson(tmp_path / "matrix.txt").shares.shape == (2, 4)


@pytest.mark.parametrize("code", [*blocks("py"), *blocks("python")])
def test_the_docs_name_what_the_library_has(code):
    """Also where an example needs a cluster that a test has not."""
    named = {
        each.attr
        for each in ast.walk(ast.parse(code))
        if isinstance(each, ast.Attribute) and isinstance(each.value, ast.Name) and each.value.id == "rtb"
    }
    assert named <= set(dir(rtb_addon))
