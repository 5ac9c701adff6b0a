"""Shapes as they stand in the world, their triangles and normals as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...scene.render_scene import RenderScene, Shape
from ...spectra import FloatArray
from .directions import normalised


def around_zero(scene: RenderScene) -> RenderScene:
    """Return a scene moved so that the middle of its shapes is the origin."""
    boxes = [_box(shape) for shape in scene.shapes if len(shape.mesh.triangles)]
    if not boxes:
        return scene
    whole = np.concatenate(boxes, axis=1)
    middle = (whole.min(axis=1) + whole.max(axis=1)) / 2

    def moved(to_world: FloatArray) -> FloatArray:
        out = to_world.astype(float)
        out[:3, 3] -= middle
        return out

    return replace(
        scene,
        camera=replace(scene.camera, to_world=moved(scene.camera.to_world)),
        shapes=tuple(replace(one, to_world=moved(one.to_world)) for one in scene.shapes),
        lights=tuple(replace(one, to_world=moved(one.to_world)) for one in scene.lights),
    )


def corners(shapes: Sequence[Shape]) -> FloatArray:
    """Return the (3, 3, triangles) corners of all triangles [m]: corner, axis, triangle."""
    return np.concatenate([np.zeros((3, 3, 0)), *map(_corners, shapes)], axis=2)


def side_of(shape: Shape) -> float:
    """Return -1 for a mirrored shape, whose corners turn the other way in the world, else 1."""
    return -1.0 if np.linalg.det(shape.to_world[:3, :3]) < 0 else 1.0


def shading_normals(shapes: Sequence[Shape], flat: FloatArray) -> FloatArray | None:
    """Return (3, 3, triangles) float32 normals, corner and axis first, or None when all shapes are flat."""
    if all(shape.mesh.normals is None for shape in shapes):
        return None
    normals = np.repeat(flat.astype(np.float32)[None], 3, axis=0)
    first = 0
    for shape in shapes:
        last = first + len(shape.mesh.triangles)
        if shape.mesh.normals is not None:
            turned = normalised(_normal_matrix(shape.to_world) @ shape.mesh.normals.T)
            normals[:, :, first:last] = turned[:, shape.mesh.triangles].transpose(2, 0, 1)
        first = last
    return normals


def _corners(shape: Shape) -> FloatArray:
    turn, place = shape.to_world[:3, :3], shape.to_world[:3, 3:]
    world = turn @ shape.mesh.vertices.T.astype(float) + place
    return world[:, shape.mesh.triangles].transpose(2, 0, 1)


def _normal_matrix(to_world: FloatArray) -> FloatArray:
    """Return what turns normals: the inverse transposed, up to length, of a flattened shape too."""
    a, b, c = to_world[:3, :3]
    sign = -1.0 if np.dot(a, np.cross(b, c)) < 0 else 1.0
    return sign * np.array([np.cross(b, c), np.cross(c, a), np.cross(a, b)])


def _box(shape: Shape) -> FloatArray:
    """Return the (3, 8) corners of the box around a mesh in its own space, as they stand in the world [m]."""
    used = shape.mesh.vertices[shape.mesh.triangles.ravel()].astype(float)
    ends = np.stack([used.min(axis=0), used.max(axis=0)])
    box = np.array([ends[[a, b, c], [0, 1, 2]] for a in (0, 1) for b in (0, 1) for c in (0, 1)]).T
    return shape.to_world[:3, :3] @ box + shape.to_world[:3, 3:]
