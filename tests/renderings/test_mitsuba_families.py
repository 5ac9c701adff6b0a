"""Renderings one after the other: what did not change is kept, and pictures are those of a fresh process."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.renderers.ply import write_mesh
from rtb_addon.scene.render_scene import Camera, Material, Mesh, Shape
from rtb_addon.spectra import Bands, Spectrum
from rtb_addon.spectral_image import SpectralImage
from tests.renderings.mitsuba_scenes import FLOOR, INTENSITY, at, globe, kernels, lamp, picture, scene

VIEW = Camera("Camera", "perspective", at(0, 0, 6), (-0.4, 0.4, -0.4, 0.4))
FEW_BANDS = Bands.regular(420, 60, 5)
SKY = lamp("environment", filename="", intensity=INTENSITY)
# 22 000 triangles, which are placed by a matrix in a small picture, and 500, which never are.
BIG, SMALL = globe(0.8, 75), globe(0.5, 12)


def family(place=(0.0, 0.0, 1.0), small=(1.4, 0.0, 0.6), glossy=None, **changes):
    shapes = [FLOOR, Shape("Big", BIG, at(*place), "paint"), Shape("Small", SMALL, at(*small), "plastic")]
    facts = {
        "camera": VIEW,
        "environment": SKY,
        "size": (12, 12),
        "depth": 4,
        "bands": FEW_BANDS,
        "samples": 16,
    }
    one = scene([lamp("point", at(-1, 2, 4), radius=0.1)], shapes, **{**facts, **changes})
    gloss = {"intIOR": 1.5, "extIOR": 1.0, "roughness": glossy or 0.2}
    plastic = Material("plastic", "roughplastic", {"diffuseReflectance": Spectrum.constant(0.4), **gloss})
    return replace(one, materials={**one.materials, "plastic": plastic})


CHANGES = {
    "a big mesh moves": {"place": (0.3, -0.2, 1.1)},
    "a small mesh moves": {"small": (-1.2, 0.3, 0.6)},
    "a spectrum changes": {"reflectance": Spectrum.of([400, 700], [0.9, 0.1])},
    "a surface is rougher": {"glossy": 0.5},
    "the camera moves": {"camera": replace(VIEW, to_world=at(0.5, 0, 5))},
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_condition_after_another_is_that_of_a_fresh_process_bit_for_bit(tmp_path, change):
    picture(family(), tmp_path, name="first")
    after = picture(family(**CHANGES[change]), tmp_path, name="second").radiance
    fresh = tmp_path / "fresh.exr"
    render = (
        "import sys; from pathlib import Path; from rtb_addon.renderers import find; "
        "from rtb_addon.renderers.interface import RenderOptions; "
        "find('mitsuba').render(Path(sys.argv[1]), RenderOptions(), lambda _: None).save(Path(sys.argv[2]))"
    )
    subprocess.run([sys.executable, "-c", render, str(tmp_path / "second.xml"), str(fresh)], check=True)
    assert np.array_equal(after, SpectralImage.load(fresh).radiance)
    assert not np.array_equal(after, picture(family(), tmp_path, name="third").radiance)


def test_what_changes_between_conditions_compiles_nothing(tmp_path):
    picture(family(), tmp_path, name="first")
    for name, change in CHANGES.items():
        ran, compiled = kernels(family(**change), tmp_path, name.replace(" ", "-"))
        assert (ran > 0, compiled) == (True, 0), name


def test_only_what_changed_is_loaded_again(tmp_path, monkeypatch):
    picture(family(), tmp_path, name="first")
    # Only now: what loads scenes may be imported once Mitsuba has its variant.
    from rtb_addon.renderers.mitsuba import loaded

    made, load = [], loaded._load
    monkeypatch.setattr(
        loaded, "_load", lambda node: made.append(node.get("id", node.get("type"))) or load(node)
    )
    for change, again in [
        ("a spectrum changes", []),
        ("a big mesh moves", []),
        ("a small mesh moves", ["Small"]),
        ("a surface is rougher", ["plastic"]),
        ("the camera moves", ["Camera"]),
    ]:
        picture(family(), tmp_path, name="first")
        made.clear()
        picture(family(**CHANGES[change]), tmp_path, name="second")
        assert made == again, change


def test_a_file_that_changed_is_read_again(tmp_path):
    one = family(bands=FEW_BANDS)
    before = picture(one, tmp_path, name="first").radiance
    mesh = next(path for path in (tmp_path / "meshes").iterdir() if path.stat().st_size > 100_000)
    flat = Mesh(BIG.vertices * np.float32([1, 1, 0.2]), BIG.triangles, BIG.normals)
    mesh.unlink()
    write_mesh(flat, tmp_path).rename(mesh)
    assert not np.array_equal(picture(one, tmp_path, name="first").radiance, before)


def test_placed_meshes_are_lit_as_others_are(tmp_path, monkeypatch):
    placed = picture(family(), tmp_path, name="placed").radiance
    monkeypatch.setattr("rtb_addon.renderers.mitsuba.loaded._PATHS_PER_TRIANGLE", 0)
    plain = picture(family(), tmp_path, name="plain").radiance
    assert not np.array_equal(placed, plain)
    # The same paths, but for the few that rounding sends elsewhere.
    assert np.median(np.abs(placed - plain)) < 1e-5 * plain.mean()
    np.testing.assert_allclose(placed.mean(axis=(0, 1)), plain.mean(axis=(0, 1)), rtol=2e-3)
