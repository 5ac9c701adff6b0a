"""
How fast the internal tracer is, and how near the limit that its ray kernel sets.

    python benchmarks/tracer.py [rounds] [size] [samples] [sphere's rings]

Prints, for a Cornell-like matte box (31 bands, depth 6) without and with a fine smooth sphere in it, the best
round on one thread: millions of paths a second of processor time, the share of that time inside the ray
kernel, and the seconds before the first path.
"""

import sys
import time

import numpy as np

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.tracer import intersect, passes
from rtb_addon.renderers.tracer.kernels import Embree
from rtb_addon.scene.render_scene import Camera, Film, Integrator, Material, Mesh, RenderScene, Shape
from rtb_addon.spectra import Spectrum, Unit

SQUARE = Mesh(
    np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32),
    np.array([[0, 1, 2], [0, 2, 3]], np.int32),
)
PAINTS = {
    "white": Spectrum.of([400, 700], [0.7, 0.75]),
    "red": Spectrum.of([400, 560, 620, 700], [0.05, 0.06, 0.6, 0.65]),
    "green": Spectrum.of([400, 480, 540, 600, 700], [0.05, 0.1, 0.5, 0.1, 0.06]),
    "black": Spectrum.constant(0.0),
}


class Timed(Embree):
    """Embree with a stopwatch."""

    seconds = 0.0

    def __init__(self, corners):
        super().__init__(corners)
        super().closest(np.zeros((1, 3), np.float32), np.ones((1, 3), np.float32), None)  # builds the tree

    def closest(self, *rays):
        start = time.process_time()
        hits = super().closest(*rays)
        Timed.seconds += time.process_time() - start
        return hits

    def blocked(self, *rays):
        start = time.process_time()
        blocked = super().blocked(*rays)
        Timed.seconds += time.process_time() - start
        return blocked


def placed(place, x=(1, 0, 0), y=(0, 1, 0), z=(0, 0, 1)):
    matrix = np.eye(4)
    matrix[:3] = np.array([x, y, z, place], float).T
    return matrix


def cube(name, place, half, degrees):
    """Yield the six sides of a box that stands on the floor, turned about the vertical."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    x, y, z = (
        half[0] * np.array([cosine, sine, 0]),
        half[1] * np.array([-sine, cosine, 0]),
        np.array([0, 0, half[2]]),
    )
    for number, (a, b, c) in enumerate([(x, y, z), (y, z, x), (z, x, y)]):
        for side in (-1, 1):
            yield Shape(
                f"{name} {number} {side}", SQUARE, placed(place + side * c, side * a, b, side * c), "white"
            )


def sphere(rings):
    """Return a smooth unit sphere of 4 rings^2 triangles."""
    latitude, longitude = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    b, a = np.meshgrid(latitude, longitude, indexing="ij")
    points = np.stack([np.sin(b) * np.cos(a), np.sin(b) * np.sin(a), np.cos(b)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    corner = i * (2 * rings + 1) + j
    below = corner + 2 * rings + 1
    triangles = np.stack([corner, below, below + 1, corner, below + 1, corner + 1], axis=-1).reshape(-1, 3)
    return Mesh(points.astype(np.float32), triangles.astype(np.int32), points.astype(np.float32))


def box(size, samples, more=()):
    """Return a Cornell-like box, open to the front."""
    walls = [
        Shape("floor", SQUARE, placed((0, 0, -1)), "white"),
        Shape("ceiling", SQUARE, placed((0, 0, 1), y=(0, -1, 0), z=(0, 0, -1)), "white"),
        Shape("back", SQUARE, placed((0, 1, 0), y=(0, 0, 1), z=(0, -1, 0)), "white"),
        Shape("left", SQUARE, placed((-1, 0, 0), x=(0, 1, 0), y=(0, 0, 1), z=(1, 0, 0)), "red"),
        Shape("right", SQUARE, placed((1, 0, 0), x=(0, 0, 1), y=(0, 1, 0), z=(-1, 0, 0)), "green"),
    ]
    lamp = Shape(
        "lamp",
        SQUARE,
        placed((0, 0, 0.99), (0.25, 0, 0), (0, -0.25, 0), (0, 0, -1)),
        "black",
        Spectrum.constant(10.0, Unit.RADIANCE),
    )
    tall, small = (
        cube("tall", (-0.35, 0.3, -0.4), (0.3, 0.3, 0.6), 17),
        cube("small", (0.35, -0.3, -0.7), (0.3,) * 3, -17),
    )
    camera = Camera(
        "camera",
        "perspective",
        placed((0, -3.9, 0), y=(0, 0, 1), z=(0, -1, 0)),
        (-0.357, 0.357, -0.357, 0.357),
    )
    return RenderScene(
        camera,
        (*walls, *tall, *small, lamp, *more),
        {name: Material(name, "matte", {"diffuseReflectance": paint}) for name, paint in PAINTS.items()},
        integrator=Integrator("path", 6, samples),
        film=Film(size, size),
    )


def measure(scene, rounds):
    """Return millions of paths a second, the kernel's share, and the seconds before the first path."""
    paths = scene.film.width * scene.film.height * scene.integrator.samples
    results = []
    for _ in range(rounds):
        start = time.process_time()
        intersect._warm.clear()
        painter = passes.Alone(scene, Timed)
        ready, Timed.seconds = time.process_time(), 0.0
        passes.render(scene, painter, RenderOptions(), lambda fraction: None)
        setup, taken = ready - start, time.process_time() - ready
        results.append((paths / taken / 1e6, Timed.seconds / taken, setup))
    return max(results)


def main(rounds=5, size=128, samples=16, rings=274):
    ball = Shape(
        "ball", sphere(rings), placed((0.35, -0.3, -0.1), (0.3, 0, 0), (0, 0.3, 0), (0, 0, 0.3)), "white"
    )
    for name, more in (("box", ()), (f"box and {4 * rings**2} triangles", (ball,))):
        speed, share, setup = measure(box(size, samples, more), rounds)
        print(f"{name}: {speed:.2f} million paths/s, {share:.0%} in the ray kernel, {setup:.2f} s to set up")


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
