"""
The internal tracer against stock Mitsuba's spectral film and our own Mitsuba path, in one interleaved run.

    python benchmarks/tracer.py [rounds] [size] [threads]

For a Cornell-like matte box, and for a mesh of 326 432 triangles under a picture of the sky (31 bands, depth
6), it prints for each way of rendering its best wall time and its efficiency, 1 / (relative mean squared
error x time), over that of the stock film: by the mean error over pixels and bands, and by their median.
Then what one process of the tracer does: paths per second of processor time, the share of it inside the ray
kernel, and the seconds before the first path.
"""

import sys
import tempfile
import time
from dataclasses import replace
from functools import partial
from pathlib import Path

import lobe_scenes
import numpy as np
from lobe_path import FILM, FILM_AS_SHIPPED, SAMPLES, SPECTRAL, errors, lobe, measured, stock

from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, session
from rtb_addon.renderers.tracer import intersect, passes
from rtb_addon.renderers.tracer.kernels import Embree

LOBE, TRACER = "lobe path", "tracer"


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


def traced(scene, folder, threads):
    """Return the tracer, a function of the seed."""

    def render(seed):
        seeded = replace(scene, integrator=replace(scene.integrator, seed=seed))
        native = find(TRACER).translate(seeded, (), folder, "scene")
        return find(TRACER).render(native, RenderOptions(threads), lambda fraction: None).radiance

    return render


def ways(scene, folder, threads):
    """Return each way by name: Mitsuba's variant, and a function of the seed that returns an image."""
    native, samples = find("mitsuba").translate(scene, (), folder, "scene"), scene.integrator.samples
    return {
        FILM: (SPECTRAL, stock(native, samples, threads, SPECTRAL, "multijitter")),
        FILM_AS_SHIPPED: (SPECTRAL, stock(native, samples, threads, SPECTRAL, "independent")),
        LOBE: (session.FAST, lobe(native, threads, "averaged")),
        TRACER: (session.FAST, traced(scene, folder / TRACER, threads)),
    }


def compare(title, scene, folder, rounds, threads):
    """Print each way's best time and its efficiency."""
    found = ways(scene, folder, threads)
    seconds, images = measured(found, rounds, threads, time.perf_counter)
    efficiency = {name: 1 / (errors(images[name]) * seconds[name]) for name in found}
    samples = scene.integrator.samples
    head = f"{title}, {samples} samples | time [s] | Mpaths/s | efficiency over specfilm | and as shipped"
    print(f"\n| {head} |\n| --- | --- | --- | --- | --- |")
    for name in found:
        ratios = (efficiency[name] / efficiency[other] for other in (FILM, FILM_AS_SHIPPED))
        cells = " | ".join(f"{mean:.1f} mean, {median:.1f} median" for mean, median in ratios)
        speed = scene.film.width**2 * samples / seconds[name] / 1e6
        print(f"| {name} | {seconds[name]:.3f} | {speed:.2f} | {cells} |")


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
    print(f"\none process: {speed:.2f} Mpaths/s, {share:.0%} in the ray kernel, {setup:.2f} s to set up")


def main(rounds=5, size=128, threads=2):
    if llvm.prepare() is None:
        raise SystemExit("no LLVM works here")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scenes = {"box": lobe_scenes.box, "mesh": partial(lobe_scenes.mesh, picture=lobe_scenes.sky(folder))}
        for title, make in scenes.items():
            scene = make(size, SAMPLES[title], glossy="matte")
            compare(title, scene, folder, rounds, threads)
            one_process(scene, rounds)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
