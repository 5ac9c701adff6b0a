"""A batch of the tracer, killed and killed again: nothing is lost, nothing is broken, nobody is left."""

import json
import random
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.processes import runs
from rtb_addon.spectral_image import SpectralImage

ROOT = Path(__file__).resolve().parents[2]
NAMES = [f"c{number:02}" for number in range(30)]


@pytest.fixture
def family(write_family):
    """Write a family of thirty greys that the tracer renders in about a tenth of a second each."""
    paints = {name: f"0.{number + 10}" for number, name in enumerate(NAMES)}
    return write_family(paints, renderer="tracer", width=24, height=18, samples=64)


def cubes(recipe):
    """Return the cubes that are there, by name of their condition."""
    files = {condition.name: recipe.rendering_file(condition) for condition in recipe.conditions}
    return {name: file for name, file in files.items() if file.is_file()}


def start(recipe):
    command = [sys.executable, "-m", "rtb_addon", "render", str(recipe.folder), "--jobs", "2", "--json"]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


def wait_for_rendering(batch):
    """Return once a worker has a condition to render, however slow the machine is."""
    for line in batch.stdout:
        if json.loads(line).get("condition") and json.loads(line)["kind"] in {"progress", "done"}:
            break


def workers_of(pid):
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def kill(process):
    """Kill a batch; return once its workers have ended, which must be within two seconds."""
    workers = workers_of(process.pid)
    process.kill()
    process.communicate()
    end = time.monotonic() + 2
    while any(map(runs, workers)):
        assert time.monotonic() < end, "a worker outlived its batch"
        time.sleep(0.01)


def test_twenty_kills_lose_no_cube_break_none_and_leave_no_process(family):
    moments, finished = random.Random(1), {}
    for number in range(20):
        batch = start(family)
        if number % 2:
            wait_for_rendering(batch)
        time.sleep(moments.uniform(0, 0.6))
        kill(batch)
        for name, file in cubes(family).items():
            SpectralImage.load(file)
            written = file.stat().st_mtime_ns
            assert finished.setdefault(name, written) == written, f"kill {number} cost {name}"
        assert set(cubes(family)) == set(finished)
        strays = [file for file in (family.folder / "renderings").rglob("*.exr") if file.stem not in NAMES]
        assert not strays
    assert finished, "no kill hit a batch that had rendered anything"
    last = start(family)
    last.communicate(timeout=120)
    assert last.returncode == 0
    assert set(cubes(family)) == set(NAMES)
    assert not [file for file in family.folder.rglob(".*") if file.is_file()]
    # Under one lamp, radiance is in proportion to reflectance, and all have the same noise.
    means = [SpectralImage.load(cubes(family)[name]).radiance.mean() for name in NAMES]
    np.testing.assert_allclose(means, means[0] * np.arange(10, 40) / 10, rtol=1e-5)


def test_two_batches_of_the_tracer_give_the_same_bits(family):
    def render():
        batch = [sys.executable, "-m", "rtb_addon", "render", str(family.folder), "--fresh", "--json"]
        subprocess.run([*batch, "--conditions", "c00,c29"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        return [SpectralImage.load(file).radiance for file in cubes(family).values()]

    for first, second in zip(render(), render(), strict=True):
        np.testing.assert_array_equal(first, second)
