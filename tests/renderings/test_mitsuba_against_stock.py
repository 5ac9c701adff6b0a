"""Every material under every kind of lamp is what stock Mitsuba's spectral film shows, within both noises."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from PIL import Image

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import renderer, session
from rtb_addon.scene.render_scene import Texture
from rtb_addon.scene.vocabulary import TEXTURES
from tests.renderings.materials_scene import LAMPS, MATERIALS, MORE, of, row
from tests.renderings.noise import CHANCE, error_of_mean, in_blocks, least_probability

RELIEFS = {
    "bumpmap": {"materialID": "metal ggx", "textureID": "waves", "scale": 0.1},
    "bumpmap clear": {"materialID": "roughglass", "textureID": "waves", "scale": 0.1},
    "normalmap": {"materialID": "principled", "textureID": "normals"},
    "normalmap two": {"materialID": "anisoward", "textureID": "normals"},
}
EVERY = {**MATERIALS, **MORE, **RELIEFS}


def textures(folder):
    """Return gentle waves, and normals that lean by up to some 20 degrees."""
    folder.mkdir(exist_ok=True)
    u, v = np.meshgrid((np.arange(32) + 0.5) / 32, (np.arange(16) + 0.5) / 16)
    waves = 0.5 + 0.25 * np.sin(2 * np.pi * 4 * u) + 0.25 * np.cos(2 * np.pi * 2 * v)
    slopes = 0.35 * np.stack([np.sin(2 * np.pi * 3 * u), np.cos(2 * np.pi * 2 * (u + v))], axis=-1)
    normals = np.dstack([slopes, np.sqrt(1 - (slopes**2).sum(axis=-1))])
    pictures = {"waves": np.dstack([waves] * 3), "normals": (normals + 1) / 2}
    made = {}
    for name, numbers in pictures.items():
        Image.fromarray((255 * numbers).round().astype(np.uint8)).save(folder / f"{name}.png")
        defaults = {key: each.default_value() for key, each in TEXTURES["bitmap"].items()}
        made[name] = Texture(name, "bitmap", {**defaults, "filename": str(folder / f"{name}.png")})
    return made


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """Return a function that gives our pictures of the row under a lamp, and stock Mitsuba's, by seed."""
    folder = tmp_path_factory.mktemp("materials")

    @cache
    def render(light):
        scene = row(light, tuple(EVERY), EVERY)
        scene = replace(scene, textures=textures(folder / "pictures"))
        native = renderer().translate(scene, (), folder, light)
        ours = [rendered(native, seed) for seed in range(6)]
        mi = session.start("llvm_ad_spectral", 1)
        loaded = mi.load_file(str(native))
        theirs = [np.array(mi.render(loaded, spp=256, seed=seed)) for seed in range(100, 116)]
        return np.stack(ours), np.stack(theirs)

    return render


def rendered(native, seed):
    text = native.read_text()
    other = native.with_name(f"{native.stem}-{seed}.xml")
    other.write_text(text.replace('name="seed" value="0"', f'name="seed" value="{seed}"'))
    return renderer().render(other, RenderOptions(), lambda fraction: None).radiance


@pytest.mark.parametrize("light", LAMPS)
@pytest.mark.parametrize("name", EVERY)
def test_a_material_is_what_stock_mitsubas_spectral_film_shows(both, name, light):
    ours, theirs = (
        np.stack([in_blocks(of(image, name, tuple(EVERY)), 4) for image in images]) for images in both(light)
    )
    assert least_probability(ours, theirs) > CHANCE
    # What could differ unseen: a few errors of the mean of the stock film, whose colours are noisy.
    assert (error_of_mean(ours)[-1] < 0.02).all()
    assert (error_of_mean(theirs)[-1] < 0.03).all()
