"""
Long tails, reliefs, pictures of the sky, lenses: both renderers, which share no code, show the same.

As in test_materials_agree.py their own noise is the tolerance, band by band and block by block.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from rtb_addon.exr import write_exr
from rtb_addon.scene.render_scene import Camera, Material, Mesh, Shape, Texture
from rtb_addon.scene.vocabulary import TEXTURES
from rtb_addon.spectra.channels import channel_name
from tests.renderings.materials_scene import BANDS, INTENSITY, LAMPS, MATERIALS, MORE, PIXELS, row
from tests.renderings.mitsuba_scenes import at, lamp
from tests.renderings.noise import CHANCE, in_blocks, least_probability
from tests.renderings.test_materials_agree import NAMES, rendered

TAILS = ("metal ggx", "roughplastic ggx", "roughglass ggx")
RELIEVED = {"bumpmap": ("matte", "metal", "glass"), "normalmap": ("matte", "roughplastic", "mask")}


def tails(light, folder, seed):
    return row(light, TAILS, {name: MORE[name] for name in TAILS}, seed=seed, samples=100)


def globe(rings=16):
    """Return a smooth ball with texture coordinates: longitude and latitude, the seam behind."""
    v, u = np.meshgrid(np.linspace(0, 1, rings + 1), np.linspace(0, 1, 2 * rings + 1), indexing="ij")
    polar, turn = np.pi * v, 2 * np.pi * u
    out = np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar)], axis=-1)
    out = out.reshape(-1, 3).astype(np.float32)
    i, j = (index.ravel() for index in np.meshgrid(np.arange(rings), np.arange(2 * rings)))
    a, b = i * (2 * rings + 1) + j, (i + 1) * (2 * rings + 1) + j
    triangles = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
    uvs = np.stack([u.ravel(), 1 - v.ravel()], axis=1).astype(np.float32)
    return Mesh(0.42 * out, triangles.astype(np.int32), out, uvs)


def reliefs(model, light, folder, seed):
    """Return balls of some materials with one relief around all."""
    numbers = np.random.default_rng(7).random((3, 12, 24)).astype(np.float32)
    if model == "normalmap":
        numbers[:2] = 0.5 + 0.4 * (numbers[:2] - 0.5)
        numbers[2] = 0.9
    path = folder / f"{model}.exr"
    if not path.exists():
        write_exr(path, {}, {name: numbers[k] for k, name in enumerate("RGB")})
    said = {name: one.default_value() for name, one in TEXTURES["bitmap"].items()}
    texture = Texture("relief", "bitmap", {**said, "filename": str(path), "scaleU": 1.5})
    names = RELIEVED[model]
    one = row(light, names, {**MATERIALS}, seed=seed, samples=100)
    scale = {"scale": 0.03} if model == "bumpmap" else {}
    around = {
        f"{name} outside": Material(
            f"{name} outside", model, {"materialID": name, "textureID": "relief", **scale}
        )
        for name in names
    }
    balls = [Shape(name, globe(), at(k + 0.5, 0.5, 0.5), f"{name} outside") for k, name in enumerate(names)]
    shapes = (*balls, *(shape for shape in one.shapes if shape.id not in names))
    return replace(one, shapes=shapes, materials={**one.materials, **around}, textures={"relief": texture})


def under_a_picture(folder, seed):
    """Return balls under a random picture, bright in one place, turned about all axes."""
    texels = np.random.default_rng(8).random((5, 9, len(BANDS))).astype(np.float32) ** 3
    texels[1, 3] = 12
    path = folder / "sky.exr"
    if not path.exists():
        names = [channel_name(centre) for centre in BANDS.centres]
        write_exr(path, {}, {name: np.ascontiguousarray(texels[..., k]) for k, name in enumerate(names)})
    turn = np.eye(4)
    turn[:3, :3] = np.linalg.qr(np.random.default_rng(9).normal(size=(3, 3)))[0]
    turn[:3, :3] *= np.linalg.det(turn[:3, :3])
    sky = replace(lamp("environment", filename=str(path), intensity=INTENSITY), to_world=turn)
    one = row("environment", ("matte", "anisoward", "roughglass"), seed=seed, samples=100)
    return replace(one, environment=sky)


def through_a_lens(folder, seed):
    """Return balls of which none is sharp, seen from the side."""
    one = row("area", ("matte", "anisoward", "mirror"), seed=seed, samples=100)
    turn = at(1.5, -3, 2.5)
    back = np.array([0, -3, 2.0]) / np.sqrt(13)
    turn[:3, :3] = np.stack([[1, 0, 0], np.cross(back, [1, 0, 0]), back], axis=1)
    camera = Camera("Camera", "perspective", turn, (-0.4, 0.4, -0.15, 0.15), (1e-2, 1e3), 0.15, 2.5)
    return replace(one, camera=camera)


SCENES = {
    **{f"long tails, {light}": partial(tails, light) for light in LAMPS},
    **{f"{model}, {light}": partial(reliefs, model, light) for model in RELIEVED for light in LAMPS[::2]},
    "picture of the sky": under_a_picture,
    "lens": through_a_lens,
}


@pytest.mark.parametrize("name", SCENES)
def test_both_renderers_show_the_same(tmp_path, name):
    ours, theirs = (
        np.stack(
            [
                in_blocks(image, PIXELS // 2)
                for image in rendered(one, partial(SCENES[name], tmp_path), tmp_path)
            ]
        )
        for one in NAMES
    )
    assert least_probability(ours, theirs) > CHANCE
    assert least_probability(ours, 1.1 * theirs) < CHANCE
