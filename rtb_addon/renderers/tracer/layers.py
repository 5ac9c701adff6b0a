"""What a picture knows beside radiance: what the middle of each pixel sees, and light by its bounces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...layers import Layers
from ...scene.render_scene import IntArray, RenderScene
from ...spectra import FloatArray
from ..interface import RenderOptions, Report
from ..rounds import Rounds
from .camera import rays
from .carried import InBands
from .directions import dot, normalised
from .integrate import ONWARD, Draw, World, met_surfaces, pairs_needed, scattered
from .lights import sorted_out
from .passes import TILE, Alone, Painter, numbers_of, render, render_round
from .paths import Paths
from .sampler import Sampler
from .texture_space import corner_uvs

# Directions that tell how much of the light from the camera a surface scatters.
_DIRECTIONS = 256


def render_layers(
    scene: RenderScene, painter: Painter, names: Sequence[str], options: RenderOptions, report: Report
) -> Layers:
    """
    Return some layers of a picture, out of layers.NAMES but the standard error.

    Parameters
    ----------
    painter : paints the scene's tiles
    """
    alone, lit = Alone(scene), {"direct", "indirect"} & set(names)
    share = 0.1 if lit else 1.0
    planes = _seen(alone, names, lambda done: report(share * done))
    if lit:
        planes |= _by_bounce(scene, painter, options, lambda done: report(share + (1 - share) * done))
    part = scene.film.part
    found = {name: planes[name].reshape(part.height, part.width, -1) for name in names}
    # Lamps that are solid are seen as well, and numbered after the shapes.
    seen = [*scene.shapes, *sorted_out(scene)[1]]
    numbered = {"object": [one.id for one in seen], "material": list(scene.materials)}
    return Layers(
        {name: plane[:, :, 0] if plane.shape[2] == 1 else plane for name, plane in found.items()},
        scene.film.bands if lit or "albedo" in names else None,
        {name: tuple(ids) for name, ids in numbered.items() if name in names},
    )


def _seen(alone: Alone, names: Sequence[str], report: Report) -> dict[str, NDArray]:
    """Return (pixels, numbers) arrays of what the middles of pixels see; of its albedo if that is named."""
    scene, uvs = alone.scene, corner_uvs(alone.scene.shapes)
    step = TILE // _DIRECTIONS if "albedo" in names else TILE
    pixels = scene.film.part.width * scene.film.part.height
    found: dict[str, list[NDArray]] = {}
    for first in range(0, pixels, step):
        report(first / pixels)
        numbers = numbers_of(scene, np.arange(first, min(first + step, pixels)))
        planes = _met(scene, alone.worlds[0], numbers, uvs)
        if "albedo" in names:
            shares = [_albedo(scene, one, numbers)[:, alone.seen] for one in alone.worlds]
            planes["albedo"] = np.mean(shares, axis=0)
        for name, plane in planes.items():
            found.setdefault(name, []).append(plane)
    report(1.0)
    return {name: np.concatenate(parts) for name, parts in found.items()}


def _met(scene: RenderScene, world: World, numbers: IntArray, uvs: FloatArray) -> dict[str, NDArray]:
    """Return (pixels, numbers) arrays of what single rays meet, lamps that are solid among it."""
    paths = _through_the_middle(scene, numbers)
    hits = world.meet(paths.origins, paths.directions, paths.reach)
    met, rows = np.nonzero(hits.triangle != -1)[0], np.nonzero(hits.triangle >= 0)[0]
    some, camera = hits.only(rows), scene.camera.to_world
    points = paths.origins + np.where(hits.triangle != -1, hits.distance, 0) * paths.directions
    place = world.surfaces.places(some, paths.directions.take(rows, axis=1))
    first, second, third = uvs.take(some.triangle, axis=2)
    n, where = len(numbers), world.surfaces
    planes = {"depth": np.full((n, 1), np.inf), "normal": np.zeros((n, 3)), "uv": np.zeros((n, 2))}
    planes |= {name: np.zeros((n, 1), np.uint32) for name in ("object", "material")}
    planes["depth"][met, 0] = -dot(points - camera[:3, 3:], np.broadcast_to(camera[:3, 2:3], points.shape))[
        met
    ]
    planes["normal"][rows] = (place.side * place.normals).T
    for number, centre in enumerate(world.lights.spheres.places.T):
        ball = np.nonzero(hits.triangle == -2 - number)[0]
        planes["object"][ball] = len(scene.shapes) + 1 + number
        planes["normal"][ball] = normalised(points.take(ball, axis=1) - centre[:, None]).T
    planes["uv"][rows] = (first + some.u * (second - first) + some.v * (third - first)).T
    planes["object"][rows, 0] = where.shape.take(some.triangle) + 1
    planes["material"][rows, 0] = where.material.take(some.triangle) + 1
    return planes


def _albedo(scene: RenderScene, world: World, numbers: IntArray) -> FloatArray:
    """Return the (pixels, bands) share of the light from the camera that surfaces scatter."""
    pixel = np.repeat(np.arange(len(numbers)), _DIRECTIONS)
    sample = np.tile(np.arange(_DIRECTIONS), len(numbers))
    integrator = replace(scene.integrator, depth=max(scene.integrator.depth, 2))
    sampler = Sampler(numbers, _DIRECTIONS, pairs_needed(integrator), integrator.seed, 0)
    draw, carrier = Draw(sampler, pixel, sample), InBands(world.lights, len(numbers))
    band = np.full(len(pixel), -1) if world.materials.parts else None
    paths = _through_the_middle(scene, numbers.take(pixel))
    paths = paths._replace(carried=carrier.begin(pixel, None), band=band)
    hits = world.meet(paths.origins, paths.directions, paths.reach)
    shares = np.zeros_like(paths.carried)
    for model, theirs, met in met_surfaces(world, paths, hits, draw, 1, carrier):
        onward = scattered(theirs, model, met, draw.pair(1, ONWARD, theirs.number), carrier)
        shares[onward.number] = onward.carried
    return shares.reshape(len(numbers), _DIRECTIONS, -1).mean(axis=1)


def _by_bounce(
    scene: RenderScene, painter: Painter, options: RenderOptions, report: Report
) -> dict[str, NDArray]:
    """Return the light that came by one bounce at most, and by more; they add up to the picture."""
    whole = render(scene, painter, options, lambda done: report(0.8 * done))
    # The same random numbers: what comes by one bounce is the same in both.
    short = replace(scene, integrator=replace(scene.integrator, depth=min(scene.integrator.depth, 2)))
    direct, alone = Rounds(whole.samples), Alone(short)
    for number in range(whole.count):

        def tell(done: float, number: int = number) -> None:
            report(0.8 + 0.2 * (number + done) / whole.count)

        direct.add(render_round(short, alone, whole.samples, number, tell))
    return {"direct": direct.mean(), "indirect": whole.mean() - direct.mean()}


def _through_the_middle(scene: RenderScene, numbers: IntArray) -> Paths:
    """Return paths through the middles of pixels, by their numbers in the whole picture."""
    film = scene.film
    row, column = np.divmod(numbers, film.width)
    origins, directions, reach = rays(scene.camera, (column + 0.5) / film.width, (row + 0.5) / film.height)
    density = np.full(len(numbers), np.inf, np.float32)
    number = np.arange(len(numbers))
    return Paths(number, origins, directions.astype(np.float32), reach, density, number)
