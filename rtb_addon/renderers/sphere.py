"""
Ward's spheres under point lights, seen orthographically, in closed form: no sampling, no triangles.

The reference that other renderers are held against. Every pixel is the radiance at its middle,

    L = sum of I / d^2 [kd / pi cos_i + ks G exp(-(tan(a) / alpha)^2) cos_i],

where a is the angle between the normal and the half vector, and G is that of Ward's variant. A sphere is any
mesh whose vertices all have one distance from a point and which fills most of the ball.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import RecipeError
from ..scene.render_scene import Film, Light, Material, RenderScene, Shape
from ..spectra import FloatArray, Spectrum
from ..spectral_image import SpectralImage
from .interface import Extras, Installed, RenderOptions, Report
from .tracer import native

# Goes up when a picture of the same native scene changes.
VERSION = "1.0"
# How far a vertex may be off its sphere, for what single precision leaves of it, and how much of
# the ball its triangles must fill: a ball of 42 vertices fills 0.84, a cube 0.37.
_OFF, _FILLED = 1e-5, 0.75
_HOW = "the sphere renderer"


class Sphere:
    """The analytic renderer, as a renderer like the others."""

    name = "sphere"
    translation = native.VERSION

    def version(self) -> Installed:
        """Return the renderer's version; it is never missing."""
        return Installed(VERSION)

    def translate(self, scene: RenderScene, extras: Extras, folder: Path, name: str) -> Path:
        """Write a scene as folder/NAME.json, as the tracer does, if it is one of spheres."""
        for sentence in _refusals(scene):
            raise RecipeError(sentence)
        return native.translate(scene, extras, folder, name, self.name)

    def render(self, native_file: Path, options: RenderOptions, report: Report) -> SpectralImage:
        """Compute a native scene [W sr-1 m-2 nm-1]."""
        scene = native.read(native_file)
        report(0.0)
        radiance = _picture(scene)
        report(1.0)
        attributes = {
            "renderer": self.name,
            "renderer_version": VERSION,
            "samples": "the middle of each pixel",
        }
        return SpectralImage(radiance, scene.film.bands, scene.film.band_kind, 1.0, attributes)


def renderer() -> Sphere:
    """Return the analytic renderer."""
    return Sphere()


class Ball(NamedTuple):
    """A sphere: its middle and radius [m], and its material."""

    centre: FloatArray
    radius: float
    material: Material


def ball_of(shape: Shape, material: Material) -> Ball | None:
    """Return the sphere that a shape's vertices lie on and that its triangles fill, or None."""
    turn, place = shape.to_world[:3, :3], shape.to_world[:3, 3]
    points = shape.mesh.vertices.astype(float) @ turn.T + place
    if len(points) < 4:
        return None
    # |p|^2 = 2 c.p + r^2 - c.c, about the mean for the sake of digits.
    mean = points.mean(axis=0)
    near = points - mean
    squares = (near**2).sum(axis=1)
    unknown, *_ = np.linalg.lstsq(np.column_stack([2 * near, np.ones(len(near))]), squares, rcond=None)
    radius = float(np.sqrt(max(unknown[3] + unknown[:3] @ unknown[:3], 0.0)))
    off = np.abs(np.linalg.norm(near - unknown[:3], axis=1) - radius)
    a, b, c = (near[shape.mesh.triangles[:, corner]] for corner in range(3))
    volume = abs((np.cross(a, b) * c).sum()) / 6
    if off.max() > _OFF * radius or volume < _FILLED * 4 / 3 * np.pi * radius**3:
        return None
    return Ball(mean + unknown[:3], radius, material)


def _refusals(scene: RenderScene) -> Iterator[str]:
    """Yield a sentence for each thing that has no closed form here."""
    if scene.camera.projection != "orthographic":
        yield f"camera {scene.camera.id} is {scene.camera.projection}, {_HOW} needs an orthographic one"
    if scene.environment is not None:
        yield f"the scene has an environment, {_HOW} knows point lights only"
    for light in scene.lights:
        if light.kind != "point" or light.parameters.get("radius"):
            size = "a point light with a radius" if light.kind == "point" else light.kind
            yield f"light {light.id} is {size}, {_HOW} knows mere point lights only"
    for shape in scene.shapes:
        yield from _refused(shape, scene.materials[shape.material])
    indirect = scene.integrator.kind == "path" and scene.integrator.depth > 2
    if indirect and len(scene.shapes) > 1:
        yield f"several spheres light each other, {_HOW} follows direct light only, set the depth to 2"


def _refused(shape: Shape, material: Material) -> Iterator[str]:
    if material.model not in ("anisoward", "matte"):
        yield f"material {material.id} is {material.model}, {_HOW} knows anisoward and matte"
    elif material.parameters.get("alphaU") != material.parameters.get("alphaV"):
        yield f"material {material.id} is anisotropic, {_HOW} needs alphaU and alphaV to be the same"
    if shape.emission is not None:
        yield f"shape {shape.id} emits, {_HOW} knows point lights only"
    if ball_of(shape, material) is None:
        yield f"shape {shape.id} is no sphere, {_HOW} knows nothing else"


def _picture(scene: RenderScene) -> FloatArray:
    """Return the (height, width, bands) float32 radiance at the middles of the pixels."""
    balls = [ball for shape in scene.shapes if (ball := ball_of(shape, scene.materials[shape.material]))]
    origins, ahead, reach = _rays(scene)
    nearest = np.full(len(origins), np.inf)
    for ball in balls:
        nearest = np.minimum(nearest, _distance(ball, origins, ahead))
    picture = np.zeros((len(origins), len(scene.film.bands)))
    for ball in balls:
        seen = np.isfinite(nearest) & (_distance(ball, origins, ahead) == nearest) & (nearest <= reach)
        points = origins[seen] + nearest[seen, None] * ahead
        picture[seen] = sum(
            (_shaded(ball, balls, light, points, ahead, scene.film) for light in scene.lights),
            np.zeros((len(points), len(scene.film.bands))),
        )
    return picture.reshape(scene.film.height, scene.film.width, -1).astype(np.float32)


def _rays(scene: RenderScene) -> tuple[FloatArray, FloatArray, float]:
    """Return (pixels, 3) origins on the near plane [m], their one direction, and how far they reach [m]."""
    left, right, bottom, top = scene.camera.window
    near, far = scene.camera.clip
    x = left + (np.arange(scene.film.width) + 0.5) / scene.film.width * (right - left)
    y = top + (np.arange(scene.film.height) + 0.5) / scene.film.height * (bottom - top)
    across, up = np.meshgrid(x, y)
    places = np.stack([across.ravel(), up.ravel(), np.full(across.size, -near)], axis=1)
    turn = scene.camera.to_world[:3, :3]
    return places @ turn.T + scene.camera.to_world[:3, 3], -turn[:, 2], far - near


def _distance(ball: Ball, origins: FloatArray, directions: FloatArray) -> FloatArray:
    """Return how far along rays their first meeting with a sphere's surface is [m], infinite for none."""
    way = ball.centre - origins
    along = (way * directions).sum(axis=1)
    beside = way - along[:, None] * directions
    depth = ball.radius**2 - (beside**2).sum(axis=1)
    half = np.sqrt(np.maximum(depth, 0))
    first = np.where(along - half > 0, along - half, along + half)
    return np.where((depth > 0) & (first > 0), first, np.inf)


def _shaded(
    ball: Ball, balls: list[Ball], light: Light, points: FloatArray, ahead: FloatArray, film: Film
) -> FloatArray:
    """Return the (points, bands) radiance that points on a sphere send back along the view from one light."""
    to_light = light.to_world[:3, 3] - points
    distance = np.linalg.norm(to_light, axis=1)
    w, v = to_light / distance[:, None], -ahead
    n = (points - ball.centre) / ball.radius
    n = np.where((n @ v)[:, None] < 0, -n, n)
    incident, seen = (n * w).sum(axis=1), n @ v
    lit = (incident > 0) & (seen > 0) & ~_blocked(ball, balls, points, w, distance)
    diffuse, glossy = _lobes(ball.material, n[lit], w[lit], v, incident[lit], seen[lit], film)
    falloff = (incident[lit] / distance[lit] ** 2)[:, None]
    radiance = np.zeros((len(points), len(film.bands)))
    radiance[lit] = falloff * (diffuse + glossy) * _in_bands(light.parameters["intensity"], film)
    return radiance


def _blocked(
    here: Ball, balls: list[Ball], points: FloatArray, w: FloatArray, distance: FloatArray
) -> NDArray[np.bool_]:
    """Return which points another sphere keeps from the light; their own does where they face away."""
    others = [_distance(ball, points, w) < distance for ball in balls if ball is not here]
    return np.any(others, axis=0) if others else np.zeros(len(points), bool)


def _lobes(
    material: Material,
    n: FloatArray,
    w: FloatArray,
    v: FloatArray,
    incident: FloatArray,
    seen: FloatArray,
    film: Film,
) -> tuple[FloatArray, FloatArray]:
    """Return Ward's two lobes [sr-1] for normals n, unit vectors w to the light and v to the camera."""
    diffuse = _in_bands(material.parameters["diffuseReflectance"], film) / np.pi
    if material.model == "matte":
        return diffuse, np.zeros((len(n), len(film.bands)))
    alpha = float(material.parameters["alphaU"])  # type: ignore[arg-type]
    squared = ((w + v) ** 2).sum(axis=1)
    half = (n * (w + v)).sum(axis=1) / np.sqrt(squared)
    exponential = np.exp(-(1 - half**2) / (half * alpha) ** 2) / (np.pi * alpha**2)
    g = {
        "ward": 1 / (4 * np.sqrt(incident * seen)),
        "ward-duer": 1 / (4 * incident * seen),
        "balanced": 1 / (squared * half**4),
    }[str(material.parameters["variant"])]
    return diffuse, (g * exponential)[:, None] * _in_bands(material.parameters["specularReflectance"], film)


def _in_bands(value: object, film: Film) -> FloatArray:
    spectrum = value if isinstance(value, Spectrum) else Spectrum.constant(float(value))  # type: ignore[arg-type]
    return spectrum.in_bands(film.bands, film.band_kind)
