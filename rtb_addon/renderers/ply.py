"""Meshes as binary PLY files, named by their content and shared by all conditions."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..errors import RenderingError
from ..files import replacing
from ..scene.render_scene import Mesh

_FACE = np.dtype([("count", "u1"), ("indices", "<i4", (3,))])
_FACES = ("property list uchar int vertex_indices",)
_HEADER = 1024  # bytes, more than any header of ours has
# How our vertices may be laid out: the arrays of a Mesh and the names PLY has for their columns.
_COLUMNS = {"vertices": "xyz", "normals": ("nx", "ny", "nz"), "uvs": ("u", "v")}


def write_mesh(mesh: Mesh, folder: Path) -> Path:
    """
    Write a mesh once, in its own space, and return its file ``folder/meshes/DIGEST.ply``.

    The file is little-endian binary; a mesh of the same content finds it there and writes nothing.
    """
    path = folder / "meshes" / f"{mesh.digest}.ply"
    if not path.exists():
        with replacing(path) as temporary:
            temporary.write_bytes(_header(mesh) + _vertices(mesh).tobytes() + _faces(mesh).tobytes())
    return path


def read_mesh(path: Path) -> Mesh:
    """Read a mesh that write_mesh wrote, bit for bit."""
    content = path.read_bytes()
    header, _, body = content.partition(b"end_header\n")
    lines = header.decode("ascii", "replace").splitlines()
    vertices = _count(lines, "vertex", path)
    triangles = _count(lines, "face", path)
    names = [line.split()[-1] for line in lines if line.startswith("property float ")]
    split = 4 * vertices * len(names)
    if len(body) != split + _FACE.itemsize * triangles:
        raise RenderingError(f"{path} is damaged, remove it and translate the scene again")
    table = np.frombuffer(body[:split], "<f4").reshape(vertices, len(names))
    faces = np.frombuffer(body[split:], _FACE)
    return Mesh(triangles=faces["indices"].copy(), **_arrays(table, names))


def count_triangles(path: Path) -> int:
    """Return how many triangles a file of write_mesh has, none if it is not there; reads its header alone."""
    try:
        with path.open("rb") as file:
            lines = file.read(_HEADER).decode("ascii", "replace").splitlines()
    except OSError:
        return 0
    return _count(lines, "face", path)


def _header(mesh: Mesh) -> bytes:
    columns = [f"property float {name}" for _, names in _present(mesh) for name in names]
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(mesh.vertices)}",
        *columns,
        f"element face {len(mesh.triangles)}",
        *_FACES,
        "end_header",
    ]
    return ("\n".join(lines) + "\n").encode()


def _present(mesh: Mesh):
    return [(key, names) for key, names in _COLUMNS.items() if getattr(mesh, key) is not None]


def _vertices(mesh: Mesh) -> np.ndarray:
    return np.hstack([np.asarray(getattr(mesh, key), "<f4") for key, _ in _present(mesh)])


def _faces(mesh: Mesh) -> np.ndarray:
    faces = np.empty(len(mesh.triangles), _FACE)
    faces["count"] = 3
    faces["indices"] = mesh.triangles
    return faces


def _count(lines: list[str], element: str, path: Path) -> int:
    for line in lines:
        words = line.split()
        if words[:2] == ["element", element]:
            return int(words[2])
    raise RenderingError(f"{path} is no mesh of ours: it counts no {element}")


def _arrays(table: np.ndarray, names: list[str]) -> dict[str, np.ndarray]:
    place = {name: column for column, name in enumerate(names)}
    return {
        key: table[:, [place[name] for name in columns]].copy()
        for key, columns in _COLUMNS.items()
        if all(name in place for name in columns)
    }
