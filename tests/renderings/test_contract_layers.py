"""What every renderer's layers are: depth, normals, objects, albedo and light by its bounces."""

from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.layers import NAMES, Layers
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.scene.render_scene import Camera, Crop, Material, Mesh, Shape
from rtb_addon.spectra import Bands, Spectrum
from tests.renderings.every_renderer import no_process_stays, renderer
from tests.renderings.mitsuba_scenes import INTENSITY, REFLECTANCE, at, globe, lamp, scene, square

__all__ = ["no_process_stays", "renderer"]  # fixtures

FIVE = Bands.regular(420, 60, 5)
TILT = np.radians(30)
TILTED = np.array(
    [
        [1, 0, 0, 0],
        [0, np.cos(TILT), -np.sin(TILT), 0],
        [0, np.sin(TILT), np.cos(TILT), 0],
        [0, 0, 0, 1.0],
    ]
)
HALF = 0.5
UNWRAPPED = replace(square(0.8), uvs=np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32))
# 22 000 triangles: in a small picture this one is placed by a matrix.
BIG = globe(0.3, 75)


def stage(**changes):
    """A tilted, unwrapped sheet before the camera, a big ball before it, and nothing around."""
    camera = Camera("Camera", "perspective", at(0, 0, 3), (-HALF, HALF, -HALF, HALF))
    shapes = [Shape("Sheet", UNWRAPPED, TILTED, "paint"), Shape("Ball", BIG, at(0.6, 0.6, 1.0), "mirror")]
    facts = {"camera": camera, "size": (20, 20), "samples": 64, "bands": FIVE, "depth": 5}
    one = scene([lamp("point", at(-1, 1, 3), radius=0.0)], shapes, **{**facts, **changes})
    mirror = Material("mirror", "mirror", {"specularReflectance": INTENSITY.scaled(0.3)})
    return replace(one, materials={**one.materials, "mirror": mirror})


def layers_of(renderer, one, folder, *names):
    native = renderer.translate(one, (), folder, "scene")
    return renderer.layers(native, names, RenderOptions(), lambda fraction: None)


def through_pixels(count=20):
    """Where rays through the middles of pixels go, with the axis as one."""
    middles = (np.arange(count) + 0.5) / count * 2 * HALF - HALF
    x, y = np.meshgrid(middles, -middles)
    return np.stack([x, y, -np.ones_like(x)], axis=2)


class TestEveryRenderersLayers:
    """One contract, and each renderer that keeps it."""

    def test_depth_normals_and_uvs_are_those_of_the_sheet(self, renderer, tmp_path):
        found = layers_of(renderer, stage(), tmp_path, "depth", "normal", "uv", "object").planes
        towards = through_pixels()
        normal = TILTED[:3, 2]
        depth = -(normal @ [0, 0, 3]) / (towards @ normal)
        point = towards * depth[:, :, None] + [0, 0, 3]
        across, up = point[:, :, 0], point @ TILTED[:3, 1]
        sheet = found["object"] == 1
        assert 50 < sheet.sum() < 350
        inside = (np.abs(across) < 0.8) & (np.abs(up) < 0.8)
        assert (inside | ~sheet).all()
        np.testing.assert_allclose(found["depth"][sheet], depth[sheet], rtol=1e-5)
        np.testing.assert_allclose(
            found["normal"][sheet], np.broadcast_to(normal, (sheet.sum(), 3)), atol=1e-5
        )
        uv = np.stack([across / 1.6 + 0.5, up / 1.6 + 0.5], axis=2)
        np.testing.assert_allclose(found["uv"][sheet], uv[sheet], atol=1e-4)

    def test_where_nothing_is_there_is_nothing(self, renderer, tmp_path):
        found = layers_of(
            renderer, stage(), tmp_path, "depth", "normal", "uv", "object", "material", "albedo"
        ).planes
        nothing = found["object"] == 0
        assert nothing.any()
        assert np.isinf(found["depth"][nothing]).all()
        for name in ("normal", "uv", "material", "albedo"):
            assert not found[name][nothing].any(), name
        assert np.isfinite(found["depth"][~nothing]).all()

    def test_objects_and_materials_go_by_names_and_a_placed_mesh_is_one_of_them(self, renderer, tmp_path):
        found = layers_of(renderer, stage(), tmp_path, "object", "material", "uv", "normal")
        objects, materials = found.planes["object"], found.planes["material"]
        names = {
            kind: {found.names[kind][number - 1] for number in np.unique(plane) if number}
            for kind, plane in (("object", objects), ("material", materials))
        }
        assert names == {"object": {"Sheet", "Ball"}, "material": {"paint", "mirror"}}
        ball = objects == 1 + found.names["object"].index("Ball")
        assert (materials[ball] == 1 + found.names["material"].index("mirror")).all()
        assert (found.planes["uv"][ball] != 0).any()
        np.testing.assert_allclose(np.linalg.norm(found.planes["normal"][ball], axis=1), 1, atol=1e-5)

    def test_a_lamp_that_is_a_ball_is_an_object_like_others(self, renderer, tmp_path):
        one = replace(stage(), lights=(lamp("point", at(0, 0, 1.5), radius=0.3),))
        found = layers_of(renderer, one, tmp_path, "depth", "normal", "object")
        ball = found.planes["object"] == 1 + found.names["object"].index("Lamp")
        towards = through_pixels()
        towards = towards / np.linalg.norm(towards, axis=2, keepdims=True)
        along = -1.5 * towards[:, :, 2]
        inside = 0.3**2 - 1.5**2 + along**2
        assert (ball == (inside > 0)).all()
        point = towards * (along - np.sqrt(np.maximum(inside, 0)))[:, :, None] + [0, 0, 3]
        np.testing.assert_allclose(found.planes["depth"][ball], 3 - point[ball][:, 2], rtol=1e-5)
        normals = (point[ball] - [0, 0, 1.5]) / 0.3
        np.testing.assert_allclose(found.planes["normal"][ball], normals, atol=1e-4)

    def test_layers_call_things_as_the_scene_does_and_count_them_in_its_order(self, renderer, tmp_path):
        one = stage()
        names = {"a.b": "paint", "grün $1 & 2": "mirror", "a_b": "soot"}
        paints = {id: replace(one.materials[paint], id=id) for id, paint in names.items()}
        sheet, ball = one.shapes
        shapes = (
            replace(sheet, id="1 sheet", material="grün $1 & 2"),
            replace(ball, id="Ball.001", material="a.b"),
            replace(ball, id="Ball_001", material="a_b", mesh=Mesh(BIG.vertices, BIG.triangles[:0])),
        )
        lamps = (lamp("point", at(0, 0, 1.5), radius=0.3),)
        one = replace(one, shapes=shapes, materials=paints, lights=lamps)
        found = layers_of(renderer, one, tmp_path, "object", "material")
        assert found.names["object"] == ("1 sheet", "Ball.001", "Ball_001", "Lamp")
        assert found.names["material"] == tuple(paints)
        seen = zip(found.planes["object"].ravel(), found.planes["material"].ravel(), strict=True)
        # Nothing, and a lamp, are made of nothing.
        assert set(seen) == {(0, 0), (1, 2), (2, 1), (4, 0)}

    def test_a_mesh_without_a_map_has_no_uvs(self, renderer, tmp_path):
        bare = Mesh(UNWRAPPED.vertices, UNWRAPPED.triangles)
        one = replace(stage(), shapes=(Shape("Sheet", bare, TILTED, "paint"),))
        found = layers_of(renderer, one, tmp_path, "uv", "object").planes
        assert (found["object"] == 1).any()
        assert not found["uv"].any()

    @pytest.mark.parametrize("kind", ["averaged", "mean"])
    def test_the_albedo_is_the_spectrum_of_the_paint_in_every_band(self, renderer, tmp_path, kind):
        one = stage(kind=kind)
        found = layers_of(renderer, one, tmp_path, "albedo", "material")
        paint = found.planes["material"] == 1 + found.names["material"].index("paint")
        expected = np.broadcast_to(REFLECTANCE.in_bands(FIVE), (paint.sum(), 5))
        tolerance = 1e-5 if kind == "averaged" else 5e-3
        np.testing.assert_allclose(found.planes["albedo"][paint], expected, rtol=tolerance)
        mirror = found.planes["material"] == 1 + found.names["material"].index("mirror")
        np.testing.assert_allclose(
            found.planes["albedo"][mirror],
            np.broadcast_to(INTENSITY.scaled(0.3).in_bands(FIVE), (mirror.sum(), 5)),
            rtol=tolerance,
        )

    def test_direct_and_indirect_light_add_up_to_the_picture(self, renderer, tmp_path):
        one = stage(environment=lamp("environment", filename="", intensity=Spectrum.constant(0.5)))
        image = renderer.render(
            renderer.translate(one, (), tmp_path, "whole"), RenderOptions(), lambda fraction: None
        )
        found = layers_of(renderer, one, tmp_path, "direct", "indirect").planes
        np.testing.assert_allclose(found["direct"] + found["indirect"], image.radiance, rtol=1e-5)
        short = stage(environment=one.environment, depth=2)
        alone = renderer.render(
            renderer.translate(short, (), tmp_path, "short"), RenderOptions(), lambda fraction: None
        )
        np.testing.assert_allclose(found["direct"], alone.radiance, rtol=1e-5)
        assert (found["indirect"] > 0.01 * image.radiance.mean()).any()
        assert found["indirect"].min() > -1e-5 * image.radiance.mean()

    def test_layers_are_cropped_as_the_picture_is(self, renderer, tmp_path):
        one, part = stage(), Crop(4, 7, 9, 6)
        whole = layers_of(renderer, one, tmp_path, "depth", "normal").planes
        cut = layers_of(
            renderer, replace(one, film=replace(one.film, crop=part)), tmp_path, "depth", "normal"
        ).planes
        for name in ("depth", "normal"):
            np.testing.assert_array_equal(cut[name], whole[name][7:13, 4:13])

    def test_every_layer_survives_its_file(self, renderer, tmp_path):
        names = [name for name in NAMES if name != "standard_error"]
        seen = []
        native = renderer.translate(stage(), (), tmp_path, "scene")
        found = renderer.layers(native, names, RenderOptions(), seen.append)
        assert seen == sorted(seen)
        found.save(tmp_path / "layers.exr")
        again = Layers.load(tmp_path / "layers.exr")
        assert again.names == {kind: tuple(names) for kind, names in found.names.items()}
        assert list(again.planes) == names
        for name in names:
            np.testing.assert_array_equal(
                again.planes[name], found.planes[name].astype(again.planes[name].dtype)
            )
