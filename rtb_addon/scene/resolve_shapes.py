"""The shapes of a scene: the meshes of its nodes, each part with its material."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache

import numpy as np

from ..errors import RecipeError, at
from ..spectra import FloatArray, Spectrum
from .collada_meshes import Part, geometry_parts
from .collada_nodes import Instance
from .document import Scene
from .render_scene import Mesh, Shape
from .resolve_materials import Materials

_MIRROR = np.diag([-1.0, 1.0, 1.0, 1.0])


def shapes_of(
    document: Scene,
    placed: list[Instance],
    materials: Materials,
    emissions: Mapping[str, Spectrum],
) -> Iterator[Shape]:
    """
    Yield the shapes of a scene; their ids begin with those of their geometries.

    Parameters
    ----------
    emissions : radiance of those geometries that emit, by id
    """
    parts = _parts_by_id(document, placed)
    total = Counter[str]()
    for instance in placed:
        total[instance.thing.get("id")] += len(parts[instance.thing.get("id")])
    made = Counter[str]()
    for instance in placed:
        id = instance.thing.get("id")
        for part in parts[id]:
            name = f"{id}_{made[id]}" if total[id] > 1 else id
            made[id] += 1
            if (shape := _shape(document, instance, part, name, materials, emissions.get(id))) is not None:
                yield shape


def _shape(
    document: Scene,
    instance: Instance,
    part: Part,
    name: str,
    materials: Materials,
    emission: Spectrum | None,
) -> Shape | None:
    size = np.linalg.det(instance.to_world[:3, :3])
    if size == 0:
        materials.values.warnings.append(f"{instance.name} is scaled to nothing and left out")
        return None
    material = _material(document, instance, part.symbol)
    materials.use(material)
    mesh, to_world = (part.mesh, instance.to_world) if size > 0 else _unmirrored(part.mesh, instance.to_world)
    return Shape(name, mesh, to_world, material, emission or materials.emission(material))


def _parts_by_id(document: Scene, placed: list[Instance]) -> dict[str, tuple[Part, ...]]:
    found: dict[str, tuple[Part, ...]] = {}
    for instance in placed:
        if (id := instance.thing.get("id")) not in found:
            with at(document.file, document.line_of(instance.thing)):
                found[id] = geometry_parts(instance.thing)
    return found


def _material(document: Scene, instance: Instance, symbol: str) -> str:
    """Return the id of a part's material: as bound, or by the symbol itself, as very old files have it."""
    for bound in instance.link.iter("{*}instance_material"):
        if bound.get("symbol") == symbol:
            return document.linked(bound.get("target"), "material").get("id")
    for id in (symbol, f"{symbol}-material"):
        if symbol and document.element(id) is not None:
            return id
    message = f"the object {instance.name} has no material, give it one in the modeller"
    raise RecipeError(message, document.file, document.line_of(instance.link))


@lru_cache(maxsize=256)
def _mirrored(mesh: Mesh) -> Mesh:
    """Return a mesh with its X axis turned round, its triangles running the other way."""
    turn = np.array([-1, 1, 1], np.float32)
    normals = None if mesh.normals is None else mesh.normals * turn
    return Mesh(mesh.vertices * turn, np.ascontiguousarray(mesh.triangles[:, ::-1]), normals, mesh.uvs)


def _unmirrored(mesh: Mesh, to_world: FloatArray) -> tuple[Mesh, FloatArray]:
    """Return the same shape with a matrix that does not mirror, so that no renderer has to know."""
    return _mirrored(mesh), to_world @ _MIRROR
