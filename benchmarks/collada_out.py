"""
A million triangles from Blender to Collada: the bridge beside Blender 4.5's own exporter.

    python benchmarks/collada_out.py

Both leave a file behind. Times are of the processor, so that a busy machine changes them little.
"""

import os
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("BLENDER_USER_RESOURCES", tempfile.mkdtemp(prefix="rtb-blender-user-"))

import bpy
import numpy as np

from rtb_addon.blender import read_recipe, register
from rtb_addon.scene.primitives import sphere


def model(smooth: bool) -> None:
    """Make a scene of one sphere of a million triangles, with texture coordinates."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    surface = sphere(1.0, 1000, 500)
    corners, count = surface.triangles.ravel(), len(surface.triangles)
    mesh = bpy.data.meshes.new("Big")
    mesh.vertices.add(len(surface.vertices))
    mesh.vertices.foreach_set("co", surface.vertices.ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
    mesh.update(calc_edges=True)
    layer = mesh.uv_layers.new(name="UVMap")
    layer.uv.foreach_set("vector", surface.uvs.values[surface.uvs.indices].astype(np.float32).ravel())
    (mesh.shade_smooth if smooth else mesh.shade_flat)()
    mesh.materials.append(bpy.data.materials["Material"])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Big", mesh))


def seconds(act, times: int = 3) -> float:
    """Return the least processor time of several runs [s]."""
    taken = []
    for _ in range(times):
        begin = time.process_time()
        act()
        taken.append(time.process_time() - begin)
    return min(taken)


def main() -> None:
    """Print both times and their ratio, for flat and smooth faces."""
    register()
    folder = Path(tempfile.mkdtemp(prefix="rtb-collada-"))
    for smooth in (False, True):
        model(smooth)
        theirs = seconds(
            lambda: bpy.ops.wm.collada_export(filepath=str(folder / "blender.dae"), triangulate=True)
        )
        ours = seconds(lambda: read_recipe(bpy.context.scene).save(folder / f"recipe-{time.time_ns()}"))
        kind = "smooth" if smooth else "flat"
        print(f"{kind}: Blender's exporter {theirs:.2f} s, the bridge {ours:.2f} s: {ours / theirs:.2f}")


if __name__ == "__main__":
    sys.exit(main())
