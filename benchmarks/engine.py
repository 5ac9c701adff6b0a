"""
What the engine adds to the renderings of a family: time, and memory that must not grow with the table.

    python benchmarks/engine.py [renderer] [conditions] [conditions of the long table]

Prints, for a family of spectra on a sphere over a floor (320x240, 31 bands, 16 samples) and one worker, wall
time over the sum of the pure render times, and what the difference is made of; for a long table of tiny
images, how long it takes to open it again and find nothing to do, and the peak memory of batch and worker
beside those of a short table.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from rtb_addon import SceneBuilder, new_recipe
from rtb_addon.scene.build import Placement

MAPPINGS = """\
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = (paint)
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = 300:10 800:10
}
"""
# Runs a batch in a process of its own and prints its peak memory and its workers' [MB].
MEASURED = """
import resource, sys
from rtb_addon.batch import render_recipe
kinds = [event.kind for event in render_recipe(sys.argv[1], jobs=1)]
assert "failed" not in kinds
print(*(resource.getrusage(who).ru_maxrss / 1024 for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))
"""


def parent():
    """Return a sphere over a floor, under a lamp."""
    scene = SceneBuilder()
    scene.camera("Camera", placement=Placement((0, -6, 2.5), (70, 0, 0)))
    scene.point("Lamp", placement=Placement((2, -2, 4)))
    scene.plane("Floor", 8, 8)
    scene.sphere("Ball", 1, "Paint", Placement((0, 0, 1)))
    return scene.tobytes()


def family(folder, count, **options):
    """Write a family of graded greys."""
    rows = "".join(f"c{k:04}\t300:{0.1 + 0.8 * k / count:.6f} 800:0.9\n" for k in range(count))
    return new_recipe(folder, parent(), conditions="imageName\tpaint\n" + rows, mappings=MAPPINGS, **options)


def rendered(recipe):
    """Render a recipe as its users do; return the wall time [s]."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "rtb_addon", "render", str(recipe.folder), "--jobs", "1", "--json"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - began


def spans(recipe):
    """Return the sums of what renderings and whole conditions took [s]."""
    files = [json.loads(recipe.record_file(condition).read_text()) for condition in recipe.conditions]
    return sum(file["seconds rendering"] for file in files), sum(file["seconds"] for file in files)


def peaks(recipe):
    """Render a recipe; return the peak memory of the batch and of its worker [MB]."""
    command = [sys.executable, "-c", MEASURED, str(recipe.folder)]
    return [float(word) for word in subprocess.run(command, check=True, capture_output=True).stdout.split()]


def main(renderer="tracer", conditions=24, long=1000):
    with tempfile.TemporaryDirectory() as place:
        recipe = family(Path(place) / "family", conditions, renderer=renderer, samples=16)
        wall = rendered(recipe)
        pure, whole = spans(recipe)
        print(
            f"{conditions} conditions by {renderer}: {wall:.2f} s, pure {pure:.2f} s, ratio {wall / pure:.3f}"
        )
        print(f"  {whole - pure:.2f} s to build scenes, {wall - whole:.2f} s for all the rest")
        tiny = {"renderer": renderer, "width": 2, "height": 2, "samples": 1}
        few, many = (family(Path(place) / f"of {n}", n, **tiny) for n in (long // 10, long))
        small, large = peaks(few), peaks(many)
        rendered(many)  # makes its montage
        print(f"a table of {long}: opened again in {rendered(many):.2f} s")
        for who, before, after in zip(("batch", "worker"), small, large, strict=True):
            print(f"peak memory of the {who}: {before:.0f} MB for {long // 10} rows, {after:.0f} for {long}")


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    main(*sys.argv[1:2], *(int(word) for word in sys.argv[2:]))
