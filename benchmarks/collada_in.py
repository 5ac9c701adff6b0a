"""
How fast a Collada file becomes a scene, beside pycollada's own loader.

    python benchmarks/collada_in.py [objects] [triangles] [rounds]

Prints, for a scene of many objects and for one of many triangles, the best round in processor seconds:
ours from bytes to meshes in metres, welded, with materials, lamps and camera; pycollada's from bytes to the
bound primitives of its scene, which it neither welds nor turns to triangles.
"""

import io
import sys
import time

import numpy as np

from rtb_addon.scene.adjustments import Adjustments
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.collada import meshes
from rtb_addon.scene.document import Scene
from rtb_addon.scene.resolve import SceneSettings, resolve

GRID = 100  # objects stand in rows of as many


def lit(builder):
    builder.camera(placement=Placement((0, 0, 50)))
    builder.point("Lamp", placement=Placement((0, 0, 40)))
    return builder.tobytes()


def many_objects(count):
    """Return squares, each with a mesh and a place of its own, of fifty materials."""
    builder = SceneBuilder()
    for k in range(count):
        place = Placement((k % GRID, k // GRID, 0), (k % 90, 0, k % 45))
        builder.plane(f"Square{k}", 1, 1 + k / count, f"Paint{k % 50}", place)
    return lit(builder)


def many_triangles(count):
    """Return a wavy, smooth grid with texture coordinates."""
    side = int(np.sqrt(count / 2))
    x, y = (each.ravel() for each in np.meshgrid(*[np.linspace(-1, 1, side + 1)] * 2))
    slope = 0.5 * np.cos(10 * x)
    normals = np.column_stack([-slope, np.zeros_like(x), np.ones_like(x)])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    corner = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).ravel()
    first = np.column_stack([corner, corner + 1, corner + side + 2])
    second = np.column_stack([corner, corner + side + 2, corner + side + 1])
    builder = SceneBuilder()
    vertices = np.column_stack([x, y, np.sin(10 * x) / 20])
    builder.mesh("Waves", vertices, np.concatenate([first, second]), normals, np.column_stack([x, y]))
    return lit(builder)


def ours(data):
    meshes._known = meshes._Known()  # as a new process has it
    scene = resolve(Scene.parse(data, "parent.dae"), Adjustments(), SceneSettings(), lambda name: None).scene
    return sum(len(shape.mesh.triangles) for shape in scene.shapes)


def theirs(data):
    import collada

    loaded = collada.Collada(io.BytesIO(data))
    return sum(
        len(primitive) for bound in loaded.scene.objects("geometry") for primitive in bound.primitives()
    )


def best(load, data, rounds):
    times = []
    for _ in range(rounds):
        start = time.process_time()
        count = load(data)
        times.append(time.process_time() - start)
    return min(times), count


def main(objects=10_000, triangles=2_000_000, rounds=3):
    loaders = {"ours": ours}
    try:
        import collada  # noqa: F401

        loaders["pycollada"] = theirs
    except ImportError:
        print("pycollada is not installed, pip install pycollada to compare with its loader")
    for name, data in {
        f"{objects} objects": many_objects(objects),
        f"{triangles} triangles": many_triangles(triangles),
    }.items():
        print(f"{name}, {len(data) / 1e6:.0f} MB")
        for loader, load in loaders.items():
            seconds, count = best(load, data, rounds)
            print(f"  {loader:10} {seconds:6.2f} s  {count} triangles")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
