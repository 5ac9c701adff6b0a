"""
Every material under every kind of lamp: both renderers, which share no code, show the same.

As in test_renderers_agree.py their own noise is the tolerance, band by band and block by block.
"""

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest

from rtb_addon import renderers
from rtb_addon.exr import write_exr
from rtb_addon.renderers.fidelity import fidelity
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Material, Mesh, Shape, Texture, TextureUse
from rtb_addon.scene.vocabulary import TEXTURES
from tests.renderings.materials_scene import BLUE, LAMPS, MATERIALS, RED, of, row
from tests.renderings.mitsuba_scenes import at
from tests.renderings.noise import CHANCE, error_of_mean, in_blocks, least_probability

NAMES = ("mitsuba", "tracer")
SEEDS = 8


def rendered(name, make, folder):
    """Return a renderer's pictures of make(seed), by seed; no two renderings share a seed."""
    renderer, first = renderers.find(name), 100 * (1 + NAMES.index(name))
    natives = [
        renderer.translate(make(seed), (), folder / name, f"seed-{seed}")
        for seed in range(first, first + SEEDS)
    ]
    ready = RenderOptions(), lambda fraction: None
    return np.stack([renderer.render(native, *ready).radiance for native in natives])


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """Return a function that gives a renderer's pictures of the row of balls under a lamp, by seed."""
    folder = tmp_path_factory.mktemp("materials")
    return cache(
        lambda name, light: rendered(
            name, lambda seed: row(light, seed=seed, samples=100), folder / str(light)
        )
    )


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
def test_a_material_that_is_ten_per_cent_too_bright_is_told(pictures, light):
    ours, theirs = (
        np.stack([in_blocks(of(image, "anisoward"), 4) for image in pictures(name, light)]) for name in NAMES
    )
    assert least_probability(ours, 1.1 * theirs) < CHANCE


def textured(light, folder, seed):
    """Return two squares side by side, a board of two spectra and a picture of random ones."""
    spectra = np.random.default_rng(3).random((3, 5, 4)).astype(np.float32)
    names = ("T.430,000000nm", "T.515,000000nm", "T.585,000000nm", "T.665,000000nm")
    if not (folder / "wall.exr").exists():
        write_exr(folder / "wall.exr", {}, {name: spectra[..., k].copy() for k, name in enumerate(names)})
    said = {"checkerboard": {"oddColor": RED, "evenColor": BLUE, "checksPerU": 3.0, "offsetV": 0.3}}
    said["bitmap"] = {"filename": str(folder / "wall.exr"), "wrapMode": "mirror", "scaleU": 1.7}
    textures = {
        kind: Texture(
            kind, kind, {**{name: one.default_value() for name, one in TEXTURES[kind].items()}, **mine}
        )
        for kind, mine in said.items()
    }
    materials = {
        "checkerboard": ("matte", {"diffuseReflectance": TextureUse("checkerboard")}),
        "bitmap": ("roughplastic", {**MATERIALS["roughplastic"], "diffuseReflectance": TextureUse("bitmap")}),
    }
    one = row(light, tuple(materials), {}, seed=seed, samples=49)
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    sheet = Mesh(np.pad(corners, ((0, 0), (0, 1))), np.array([[0, 1, 2], [0, 2, 3]], np.int32), uvs=corners)
    sheets = [Shape(id, sheet, at(k, 0, 0.5), id) for k, id in enumerate(materials)]
    made = {id: Material(id, *parts) for id, parts in materials.items()}
    shapes = (*sheets, *(shape for shape in one.shapes if shape.id not in materials))
    return replace(one, shapes=shapes, materials={**one.materials, **made}, textures=textures)


@pytest.mark.parametrize("light", LAMPS)
def test_textures_look_the_same_to_both(tmp_path, light):
    ours, theirs = (
        np.stack([in_blocks(image, 4) for image in rendered(n, partial(textured, light, tmp_path), tmp_path)])
        for n in NAMES
    )
    assert least_probability(ours, theirs) > CHANCE
    assert least_probability(ours, 1.1 * theirs) < CHANCE
    assert len(np.unique(ours[0].round(4), axis=0)) > 4
