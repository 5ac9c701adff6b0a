"""
The internal tracer against stock Mitsuba's spectral film and our own Mitsuba path, in one interleaved run.

    python benchmarks/tracer.py [rounds] [size] [samples] [threads]

Prints, for a Cornell-like matte box (31 bands, depth 6) without and with a smooth ball of 300 000 triangles,
each way's best wall time and its efficiency, 1 / (relative mean squared error x time), over that of the
stock film, which uses our native scene as it is: with Mitsuba's multijitter sampler, and once more with
the independent one that it has when nobody asks. Then what one process of the tracer does: paths per second
of processor time, the share of it inside the ray kernel, and the seconds before the first path.
"""

import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from lobe_path import box, placed, ways

from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, session
from rtb_addon.renderers.tracer import intersect, passes
from rtb_addon.renderers.tracer.kernels import Embree
from rtb_addon.scene.render_scene import Mesh, Shape

RINGS = 274
STOCK, LOBE = "stock specfilm, 31 bands", "lobe path, 31 bands"


class Timed(Embree):
    """Embree with a stopwatch."""

    seconds = 0.0

    def __init__(self, corners):
        super().__init__(corners)
        super().closest(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32), None)  # builds the tree

    def closest(self, origins, directions, reach):
        start = time.process_time()
        hits = super().closest(origins, directions, reach)
        Timed.seconds += time.process_time() - start
        return hits

    def blocked(self, origins, directions, reach):
        start = time.process_time()
        blocked = super().blocked(origins, directions, reach)
        Timed.seconds += time.process_time() - start
        return blocked


def ball(rings):
    """Return a smooth ball of 4 rings^2 triangles, hanging in the box."""
    latitude, longitude = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    b, a = np.meshgrid(latitude, longitude, indexing="ij")
    points = np.stack([np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    corner = i * (2 * rings + 1) + j
    below = corner + 2 * rings + 1
    triangles = np.stack([corner, below, below + 1, corner, below + 1, corner + 1], axis=-1).reshape(-1, 3)
    mesh = Mesh(points.astype(np.float32), triangles.astype(np.int32), points.astype(np.float32))
    return Shape("ball", mesh, placed((0.35, 0.1, 0.3), scale=(0.4, 0.4, 0.4)), "white")


def independent(native, samples, threads):
    """Return the stock film with the sampler that it has when nobody asks."""
    mi = session.start("llvm_ad_spectral", threads)
    other = native.with_name("independent.xml")
    other.write_text(native.read_text().replace('"multijitter"', '"independent"'))
    scene = mi.load_file(str(other))

    def render(seed):
        mi = session.start("llvm_ad_spectral", threads)
        return np.array(mi.render(scene, spp=samples, seed=seed))

    return render


def traced(scene, folder, threads):
    """Return the tracer, a function of the seed."""

    def render(seed):
        seeded = replace(scene, integrator=replace(scene.integrator, seed=seed))
        native = find("tracer").translate(seeded, (), folder, "box")
        return find("tracer").render(native, RenderOptions(threads), lambda fraction: None).radiance

    return render


def compare(scene, rounds, threads):
    """Print each way's best time and its efficiency."""
    samples = scene.integrator.samples
    with tempfile.TemporaryDirectory() as folder:
        native = find("mitsuba").translate(scene, (), Path(folder), "box")
        theirs = ways(native, samples, threads)
        found = {
            STOCK: theirs[STOCK],
            "the same, independent": independent(native, samples, threads),
            LOBE: theirs[LOBE],
            "tracer, 31 bands": traced(scene, Path(folder) / "tracer", threads),
        }
        seconds, images = {name: [] for name in found}, {name: [] for name in found}
        for turn in range(rounds + 1):
            for name, render in found.items():
                start = time.perf_counter()
                image = render(turn)
                # The first round compiles, and starts processes.
                if turn:
                    seconds[name].append(time.perf_counter() - start)
                    images[name].append(image)
    mean = np.mean(images[LOBE], axis=0, dtype=float)
    scale = (mean + 0.05 * mean.mean(axis=(0, 1))) ** 2
    cost = {n: np.mean(np.var(images[n], axis=0, ddof=1) / scale) * min(seconds[n]) for n in found}
    for name in found:
        speed = scene.film.width * scene.film.height * samples / min(seconds[name]) / 1e6
        line = f"  {name:26} {min(seconds[name]):6.3f} s   {speed:5.2f} Mpaths/s   efficiency"
        print(f"{line} {cost[STOCK] / cost[name]:5.1f} x specfilm")


def one_process(scene, rounds):
    """Print paths per second of processor time, the kernel's share, and the seconds before the first path."""
    paths = scene.film.width * scene.film.height * scene.integrator.samples
    results = []
    for _ in range(rounds):
        intersect._warm.clear()
        start = time.process_time()
        painter = passes.Alone(scene, Timed)
        ready, Timed.seconds = time.process_time(), 0.0
        passes.render(scene, painter, RenderOptions(), lambda fraction: None)
        taken = time.process_time() - ready
        results.append((paths / taken / 1e6, Timed.seconds / taken, ready - start))
    speed, share, setup = max(results)
    words = f"{speed:.2f} Mpaths/s, {share:.0%} in the ray kernel, {setup:.2f} s to set up"
    print(f"  tracer, one process: {words}")


def main(rounds=5, size=128, samples=64, threads=2):
    if llvm.prepare() is None:
        raise SystemExit("no LLVM works here")
    plain = box(size, samples)
    for name, shapes in (("box", ()), (f"box and {4 * RINGS**2} triangles", (ball(RINGS),))):
        scene = replace(plain, shapes=(*plain.shapes, *shapes))
        print(f"{name}, {size}x{size}, {samples} samples, {threads} threads")
        compare(scene, rounds, threads)
        one_process(scene, rounds)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
