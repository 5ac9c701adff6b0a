"""RenderToolbox3's and RenderToolbox4's own files, imported as anybody would, rendered in this process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from rtb_addon import SpectralImage
from rtb_addon.batch.rendering import render_condition
from rtb_addon.recipe import Recipe

ROOT = Path(__file__).resolve().parents[2]
RTB3 = Path(os.environ.get("RTB3_FOLDER", ROOT.parent / "shared" / "rtb3"))
RTB4 = Path(os.environ.get("RTB4_FOLDER", ROOT.parent / "shared" / "rtb4"))
RENDERERS = ("mitsuba", "tracer")


def old(*parts: str, at: Path = RTB3) -> Path:
    """Return one of the old files; skip the test, loudly, where they are not."""
    file = at.joinpath(*parts)
    if not file.exists():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {file}, set RTB3_FOLDER and RTB4_FOLDER")
    return file


def said(*words: str | Path) -> str:
    """Return what the command line says when all goes well."""
    done = subprocess.run(
        [sys.executable, "-m", "rtb_addon", *map(str, words)], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def rendered(recipe: Recipe, name: str, **options) -> SpectralImage:
    """Return the cube of a condition."""
    return render_condition(recipe.overridden(**options), name, lambda fraction: None).image
