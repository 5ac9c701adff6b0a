"""Materials of the tracer by themselves: what they scatter, and whether they sample as they say."""

import numpy as np
from scipy import stats

from rtb_addon.renderers.tracer.directions import dot
from rtb_addon.renderers.tracer.intersect import Places
from rtb_addon.renderers.tracer.materials import Materials
from rtb_addon.renderers.tracer.meeting import Meeting
from rtb_addon.scene.render_scene import Film
from tests.renderings.tracer_scenes import BANDS


def direction(polar, turn=0.0):
    """Return the (3, 1) unit vector at angles [degrees] from the normal and about it."""
    a, b = np.radians(polar), np.radians(turn)
    return np.array([[np.sin(a) * np.cos(b)], [np.sin(a) * np.sin(b)], [np.cos(a)]])


def met(back, n, side=1.0, model=None):
    """Return a meeting of n paths, that came from a (3, 1 or n) direction, with a level place of a model."""
    up, x, y = (np.tile(np.eye(3)[:, k : k + 1], n) for k in (2, 0, 1))
    sides = np.full(n, side)
    places = Places(up, up, np.zeros((3, n)), np.zeros(n), sides, x, np.full((2, n), 0.5), y)
    meeting = Meeting(np.zeros(n, int), places, np.broadcast_to(-back, (3, n)))
    return meeting if model is None else model.meeting(meeting)


def model_of(material, others=(), textures=()):
    """Return the tracer's model of one material, that may be made of others."""
    materials = {one.id: one for one in (material, *others)}
    made = Materials(materials, Film(bands=BANDS), {one.id: one for one in textures})
    numbers = np.zeros(1, np.int32)
    if made.mixtures is not None:
        numbers = made.mixtures.one_of(numbers, np.zeros(1))
    ((model, _, _),) = made.sorted(numbers)
    return model


def evaluate(model, back, towards, side=1.0):
    """Return f cos per band and the density for (3, n) directions."""
    meeting = met(back, towards.shape[1], side, model)
    value, density = model.evaluate(meeting, np.arange(towards.shape[1]), towards)
    shared = model.shared(meeting)
    return value * (1 if shared is None else shared), density


def grid(rows, columns, whole=True):
    """Return (3, n) directions at the middles of cells of equal solid angle, and that angle [sr]."""
    low = -1.0 if whole else 0.0
    z, turn = np.meshgrid(
        low + (np.arange(rows) + 0.5) / rows * (1 - low),
        (np.arange(columns) + 0.5) / columns * 2 * np.pi,
        indexing="ij",
    )
    r = np.sqrt(1 - z**2)
    ways = np.stack([r * np.cos(turn), r * np.sin(turn), z]).reshape(3, -1)
    return ways, 2 * np.pi * (1 - low) / (rows * columns)


def albedo(model, back, side=1.0, rows=700, columns=700):
    """Return the share of light from a direction that is scattered, per band, lobes with a density only."""
    ways, angle = grid(rows, columns)
    return evaluate(model, back, ways, side)[0].sum(axis=0, dtype=float) * angle


def assert_samples_as_it_says(model, back, side=1.0, n=100_000, seed=0):
    """
    Check the directions of a model against its densities by chi-square, and their weights.

    Cells are 1/24 of the height of the sphere by 1/32 of its turn; those where fewer than five directions are
    expected count together.
    """
    u, v = np.random.default_rng(seed).random((2, n))
    onward = model.scattered(met(back, n, side, model), u, v)
    kept = np.isfinite(onward.density) & (onward.density > 0)
    np.testing.assert_allclose(dot(onward.directions, onward.directions), 1, rtol=1e-9)
    # Straight down, narrow lobes are around the poles and the same all round.
    rows, columns, deep, wide = (24, 32, 500, 1) if back[2] > 0.99 else (24, 32, 60, 8)
    x, y, z = onward.directions[:, kept]
    cell = ((z + 1) / 2 * rows).clip(0, rows - 1).astype(int) * columns
    cell += (np.arctan2(y, x) % (2 * np.pi) / (2 * np.pi) * columns).clip(0, columns - 1).astype(int)
    seen = np.bincount(cell, minlength=rows * columns)
    ways, angle = grid(rows * deep, columns * wide)
    density = evaluate(model, back, ways, side)[1].reshape(rows, deep, columns, wide)
    expected = density.sum(axis=(1, 3)).ravel() * angle * n
    often = expected >= 5
    seen = np.append(seen[often], [seen[~often].sum(), n - seen.sum()])
    expected = np.append(expected[often], [expected[~often].sum(), n - expected.sum()])
    count = expected > 1
    chi2 = ((seen - expected)[count] ** 2 / expected[count]).sum()
    assert stats.chi2.sf(chi2, count.sum() - 1) > 1e-3, (chi2, count.sum())
    value, density = evaluate(model, back, onward.directions[:, kept], side)
    np.testing.assert_allclose(density, onward.density[kept], rtol=1e-4)
    shared = model.shared(met(back, n, side))
    weight = (1.0 if onward.weight is None else onward.weight) * (1.0 if shared is None else shared)
    weight = np.broadcast_to(weight, (n, len(BANDS)))[kept]
    np.testing.assert_allclose(weight, value / density[:, None], rtol=1e-3, atol=1e-6)
