"""
Every material under every kind of lamp: both renderers, which share no code, show the same.

As in test_renderers_agree.py their own noise is the tolerance, band by band and block by block.
"""

from functools import cache

import numpy as np
import pytest

from rtb_addon import renderers
from rtb_addon.renderers.fidelity import fidelity
from rtb_addon.renderers.interface import RenderOptions
from tests.renderings.materials_scene import LAMPS, MATERIALS, of, row
from tests.renderings.noise import CHANCE, error_of_mean, in_blocks, least_probability

NAMES = ("mitsuba", "tracer")
SEEDS = 8


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """Return a function that gives a renderer's pictures of the row of balls under a lamp, by seed."""
    folder = tmp_path_factory.mktemp("materials")

    @cache
    def render(name, light):
        renderer = renderers.find(name)
        first = 100 * (1 + NAMES.index(name))
        natives = [
            renderer.translate(row(light, seed=seed, samples=100), (), folder / name, f"{light}-{seed}")
            for seed in range(first, first + SEEDS)
        ]
        ready = RenderOptions(), lambda fraction: None
        return np.stack([renderer.render(native, *ready).radiance for native in natives])

    return render


def test_both_renderers_know_every_material_of_the_row():
    unknown = [m for m in MATERIALS for n in NAMES if fidelity(n, f"material {m}").level != "exact"]
    assert not unknown


@pytest.mark.parametrize("light", LAMPS)
@pytest.mark.parametrize("material", MATERIALS)
def test_a_material_looks_the_same_to_both(pictures, material, light):
    ours, theirs = (
        np.stack([in_blocks(of(image, material), 4) for image in pictures(name, light)]) for name in NAMES
    )
    assert least_probability(ours, theirs) > CHANCE
    # A point lamp's light through rough glass comes as sparks.
    for seeds in (ours, theirs):
        assert (error_of_mean(seeds)[-1] < 0.04).all()


@pytest.mark.parametrize("light", LAMPS)
def test_a_material_that_is_five_per_cent_too_bright_is_told(pictures, light):
    ours, theirs = (
        np.stack([in_blocks(of(image, "anisoward"), 4) for image in pictures(name, light)]) for name in NAMES
    )
    assert least_probability(ours, 1.05 * theirs) < CHANCE
