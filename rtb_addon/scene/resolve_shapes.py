"""The shapes of a scene: the meshes of its nodes, each part with its material."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from functools import lru_cache

import numpy as np

from ..errors import at
from ..spectra import FloatArray, Spectrum
from .collada.meshes import Part, geometry_parts, left_out
from .collada.nodes import Instance
from .collada.textures import uv_sets
from .document import Scene
from .paths import local_name
from .render_scene import Mesh, Shape
from .resolve_materials import NO_MATERIAL, Materials

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
    parts = _parts_of_each(document, placed, materials)
    total, made = Counter[str](), Counter[str]()
    for instance, own in zip(placed, parts, strict=True):
        total[instance.thing.get("id")] += len(own)
    for instance, own in zip(placed, parts, strict=True):
        id = instance.thing.get("id")
        for part in own:
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
    if material == NO_MATERIAL:
        materials.values.warnings.append(f"the object {instance.name} has no material and becomes grey")
    materials.use(material)
    mesh, to_world = (part.mesh, instance.to_world) if size > 0 else _unmirrored(part.mesh, instance.to_world)
    return Shape(name, mesh, to_world, material, emission or materials.emission(material))


def _parts_of_each(document: Scene, placed: list[Instance], materials: Materials) -> list[tuple[Part, ...]]:
    """Return the parts of each instance; those of one geometry are the same objects."""
    found: dict[tuple[str, str], tuple[Part, ...]] = {}
    parts = []
    for instance in placed:
        id, sets = instance.thing.get("id"), _uv_sets(document, instance, materials)
        if (key := (id, repr(sets))) not in found:
            with at(document.file, document.line_of(instance.thing)):
                found[key] = geometry_parts(instance.thing, sets)
            materials.values.warnings.extend(left_out(instance.thing))
        parts.append(found[key])
    return parts


def _uv_sets(document: Scene, instance: Instance, materials: Materials) -> dict[str, int]:
    if next(instance.link.iter("{*}bind_vertex_input"), None) is None:
        return {}
    symbols = [each.get("symbol", "") for each in instance.link.iter("{*}instance_material")]
    ids = {symbol: _material(document, instance, symbol) for symbol in symbols}
    return uv_sets(instance.link, {symbol: materials.texcoord(id) for symbol, id in ids.items()})


def _material(document: Scene, instance: Instance, symbol: str) -> str:
    """Return the id of a part's material: as bound, or by the symbol itself, as very old files have it."""
    for each in instance.link.iter("{*}instance_material"):
        if each.get("symbol") == symbol:
            return document.linked(each.get("target"), "material").get("id")
    for id in (symbol, f"{symbol}-material"):
        if symbol and (found := document.element(id)) is not None and local_name(found) == "material":
            return id
    return NO_MATERIAL


@lru_cache(maxsize=256)
def _mirrored(mesh: Mesh) -> Mesh:
    """Return a mesh with its X axis turned round, its triangles running the other way."""
    turn = np.array([-1, 1, 1], np.float32)
    normals = None if mesh.normals is None else mesh.normals * turn
    return Mesh(mesh.vertices * turn, np.ascontiguousarray(mesh.triangles[:, ::-1]), normals, mesh.uvs)


def _unmirrored(mesh: Mesh, to_world: FloatArray) -> tuple[Mesh, FloatArray]:
    """Return the same shape with a matrix that does not mirror, so that no renderer has to know."""
    return _mirrored(mesh), to_world @ _MIRROR
