"""A family shared by a Dask cluster of two workers, and by the jobs of a Slurm array."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.processes import runs
from rtb_addon.spectral_image import SpectralImage

ROOT = Path(__file__).resolve().parents[2]
NAMES = [f"c{number:02}" for number in range(12)]


@pytest.fixture
def family(write_family):
    """Write a family of greys that the tracer renders in a good second each."""
    paints = {name: f"0.{number + 10}" for number, name in enumerate(NAMES)}
    return write_family(paints, renderer="tracer", width=64, height=48, samples=1536)


@pytest.fixture
def cluster(plugin):
    """Start a scheduler and two workers, processes of their own."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as started:
        yield started


def batch_on(address, recipe, *words):
    command = [
        sys.executable,
        "-m",
        "rtb_addon",
        "render",
        str(recipe.folder),
        "--json",
        "--scheduler",
        address,
    ]
    return subprocess.Popen(
        [*command, *words], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def children_of(pid):
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def assert_all_are_right(recipe):
    """Under one lamp radiance is in proportion to reflectance, and all conditions have the same noise."""
    cubes = [SpectralImage.load(recipe.rendering_file(condition)) for condition in recipe.conditions]
    means = np.array([cube.radiance.mean() for cube in cubes])
    np.testing.assert_allclose(means, means[0] * np.arange(10, 10 + len(means)) / 10, rtol=1e-5)


def test_a_cluster_that_loses_a_worker_in_the_middle_still_renders_everything(family, cluster):
    events, killed, grandchildren = [], None, []
    with batch_on(cluster.scheduler_address, family) as batch:
        for line in batch.stdout:
            events.append(json.loads(line))
            if killed is None and events[-1]["kind"] == "progress":
                workers = [nanny.process.pid for nanny in cluster.workers.values()]
                killed = next(pid for pid in workers if children_of(pid))
                grandchildren = children_of(killed)
                os.kill(killed, signal.SIGKILL)
        assert batch.wait(timeout=60) == 0, batch.stderr.read()
    assert killed is not None
    assert not any(map(runs, grandchildren))
    ends = {event["condition"]: event["kind"] for event in events if event.get("condition")}
    assert set(ends) == set(NAMES)
    # The worker that died may have had its cube on disk already: then the second try finds it.
    assert set(ends.values()) <= {"done", "cached"}
    assert (events[0]["kind"], events[-1]["kind"], events[-1]["finished"]) == (
        "started",
        "finished",
        len(NAMES),
    )
    assert_all_are_right(family)
    assert not list(family.folder.rglob(".*"))
    with batch_on(cluster.scheduler_address, family) as again:
        kinds = [json.loads(line)["kind"] for line in again.stdout]
    assert kinds == ["started", *["cached"] * len(NAMES), "finished"]


def test_a_cancelled_batch_leaves_the_cluster_idle(family, cluster):
    batch = batch_on(cluster.scheduler_address, family)
    for line in batch.stdout:
        if json.loads(line)["kind"] == "progress":
            break
    began = time.monotonic()
    batch.send_signal(signal.SIGINT)
    batch.communicate(timeout=10)
    assert batch.returncode == 130
    assert time.monotonic() - began < 4
    workers = [nanny.process.pid for nanny in cluster.workers.values()]
    while any(children_of(pid) for pid in workers):
        assert time.monotonic() - began < 5, "a rendering goes on that nobody waits for"
        time.sleep(0.05)


def test_the_jobs_of_a_slurm_array_share_a_family(family):
    page = (ROOT / "docs" / "clusters.md").read_text()
    script = next(text for text in re.findall(r"^```sh\n(.*?)^```", page, re.M | re.S) if "--array" in text)
    script = (
        script.replace("srun ", "").replace("/shared/family", str(family.folder)).replace("/shared/venv", "")
    )
    script = script.replace("/bin/python", sys.executable)
    environment = {**os.environ, "SLURM_ARRAY_TASK_COUNT": "2"}
    jobs = [
        subprocess.Popen(
            ["bash", "-eu", "-c", script], cwd=ROOT, env={**environment, "SLURM_ARRAY_TASK_ID": str(number)}
        )
        for number in range(2)
    ]
    assert [job.wait(timeout=120) for job in jobs] == [0, 0]
    assert_all_are_right(family)
