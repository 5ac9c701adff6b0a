"""Collada's geometries, lamps, cameras and materials made into datablocks of Blender."""

from __future__ import annotations

import math

import bpy
import numpy as np

from ..scene.collada.cameras import read_camera
from ..scene.collada.colours import NO_EFFECT, Lamp, read_effect, read_lamp
from ..scene.collada.meshes import Part, geometry_parts
from ..scene.collada.sources import child
from ..scene.document import Scene
from ..scene.paths import Element
from ..scene.render_scene import Film
from ..spectra import FULL_RANGE
from . import lights
from .nodes import base_colour, has_nodes

_KINDS = {"point": "POINT", "spot": "SPOT", "directional": "SUN"}
# Normals that differ by less are those that Blender computes itself.
_SAME_NORMALS = 1e-3


def named_after(id: str, suffix: str) -> str:
    """Return the name whose id in a parent scene is this one again: Cube for Cube-mesh."""
    return id.removesuffix(suffix) or id


def make_mesh(geometry: Element) -> tuple[bpy.types.Mesh, list[str]]:
    """Return a geometry as a mesh, and the symbols of its parts, one for each material slot."""
    parts = geometry_parts(geometry)
    mesh = bpy.data.meshes.new(named_after(geometry.get("id"), "-mesh"))
    symbols = list(dict.fromkeys(part.symbol for part in parts))
    starts = np.cumsum([0, *(len(part.mesh.vertices) for part in parts)])
    vertices = np.concatenate([part.mesh.vertices for part in parts]) if parts else np.empty((0, 3))
    faces = [part.mesh.triangles + start for part, start in zip(parts, starts, strict=False)]
    mesh.from_pydata(vertices.tolist(), [], np.concatenate(faces).tolist() if faces else [])
    slots = [np.full(len(part.mesh.triangles), symbols.index(part.symbol)) for part in parts]
    if slots:
        mesh.polygons.foreach_set("material_index", np.concatenate(slots).astype(np.int32))
    _set_uvs(mesh, parts)
    _set_normals(mesh, parts)
    mesh.update()
    return mesh, symbols


def _set_uvs(mesh, parts: tuple[Part, ...]) -> None:
    if not any(part.mesh.uvs is not None for part in parts):
        return
    corners = [
        np.zeros((3 * len(m.triangles), 2)) if m.uvs is None else m.uvs[m.triangles.ravel()]
        for m in (part.mesh for part in parts)
    ]
    layer = mesh.uv_layers.new(name="UVMap")
    layer.uv.foreach_set("vector", np.concatenate(corners).astype(np.float32).ravel())


def _set_normals(mesh, parts: tuple[Part, ...]) -> None:
    """Let faces be flat where the file has no normals, else as it has them."""
    smooth = [np.full(len(part.mesh.triangles), part.mesh.normals is not None) for part in parts]
    if not smooth or not np.concatenate(smooth).any():
        mesh.shade_flat()
        return
    mesh.polygons.foreach_set("use_smooth", np.concatenate(smooth))
    meshes = [part.mesh for part in parts]
    given = [np.zeros_like(m.vertices) if m.normals is None else m.normals for m in meshes]
    wanted, own = np.concatenate(given), np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertex_normals.foreach_get("vector", own)
    if np.abs(own.reshape(-1, 3) - wanted).max(initial=0) > _SAME_NORMALS:
        mesh.normals_split_custom_set_from_vertices(wanted.tolist())


def make_material(document: Scene, material: Element) -> bpy.types.Material:
    """Return a material in the colour of its effect."""
    made = bpy.data.materials.new(named_after(material.get("id"), "-material"))
    if not has_nodes(made):  # before Blender 5 materials began without
        made.use_nodes = True
    link = child(material, "instance_effect")
    effect = NO_EFFECT if link is None else read_effect(document.linked(link.get("url"), "effect"))
    colour = (*(effect.diffuse or (0.5, 0.5, 0.5)), 1.0)
    made.diffuse_color = colour
    if (socket := base_colour(made)) is not None:
        socket.default_value = colour
    return made


def make_lamp(light: Element) -> bpy.types.Light | None:
    """Return a lamp as the file has it, a point in space; None for one that Blender has not."""
    said = read_lamp(light)
    if said.kind not in _KINDS:
        return None
    made = bpy.data.lights.new(named_after(light.get("id"), "-light"), _KINDS[said.kind])
    _set_power(made, said)
    if made.type == "SUN":
        made.angle = 0.0
        return made
    made.shadow_soft_size = 0.0
    if made.type == "SPOT":
        made.spot_size, made.spot_blend = math.radians(said.numbers["cone"]), said.numbers["blend"]
    return made


def _set_power(made, said: Lamp) -> None:
    """Give a lamp the power whose colour, per nm, is what the file says."""
    brightest = max(said.colour)
    factor = lights.sun_irradiance() if made.type == "SUN" else lights.point_intensity()
    made.energy = brightest * (FULL_RANGE[1] - FULL_RANGE[0]) / factor
    made.color = [each / brightest if brightest > 0 else 0.0 for each in said.colour]


def make_camera(camera: Element, unit: float, size: tuple[int, int]) -> bpy.types.Camera:
    """
    Return a camera that takes the same pictures.

    Parameters
    ----------
    unit : of the document's lengths [m]
    size : of the picture [pixels]
    """
    name = named_after(camera.get("id"), "-camera")
    seen = read_camera(camera, name, np.eye(4), unit, Film(*size), False)
    left, right, bottom, top = seen.window
    made = bpy.data.cameras.new(name)
    made.sensor_fit = "HORIZONTAL"
    if seen.projection == "orthographic":
        made.type, made.ortho_scale = "ORTHO", (right - left) / unit
    else:
        made.lens = made.sensor_width / (right - left)
    made.shift_x, made.shift_y = (left + right) / 2 / (right - left), (bottom + top) / 2 / (right - left)
    made.clip_start, made.clip_end = (each / unit for each in seen.clip)
    if seen.lens_radius > 0:
        made.dof.use_dof = True
        made.dof.focus_distance = seen.focus_distance / unit
        made.dof.aperture_fstop = made.lens * 1e-3 / (2 * seen.lens_radius / unit)
    return made
