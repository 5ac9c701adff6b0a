"""RenderToolbox4's own mappings in JSON, and ours like them."""

import os
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.conditions import Condition
from rtb_addon.mappings import read_mappings
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve
from tests.unit.filled_changes import RTB4, SHARED, filled, moved, nothing

RTB3 = Path(os.environ.get("RTB3_FOLDER", SHARED / "rtb3"))


def test_the_radiance_test_of_both_toolboxes_is_the_same_scene():
    scene_file = RTB3 / "ExampleScenes" / "RadianceTest" / "RadianceTest.dae"
    mappings_file = RTB4 / "ExampleScenes" / "RadianceTest" / "RadianceTestMappings.json"
    if not (scene_file.is_file() and mappings_file.is_file()):
        pytest.skip(
            f"THE OLD FILES ARE NOT HERE: {scene_file}, {mappings_file}; set RTB3_FOLDER, RTB4_FOLDER"
        )
    cells = {
        "lightDistance": "100",
        "cameraY": "5",
        "cameraZ": "5",
        "cameraXRot": "-45",
        "lightRadius": "0.01",
    }
    cells |= {"reflectorXRot": "-41.4", "groupName": "areaLightGroup", "lightSpectrum": "300:1 800:1"}
    document = Scene.read(scene_file)
    adjustments = read_mappings(mappings_file).fill_in(Condition("x", cells), "tracer", document, nothing)
    found = resolve(document, adjustments, SceneSettings(Film(100, 100)), nothing)
    assert adjustments.remarks == ()
    check_radiance_test(found.scene)


def check_radiance_test(scene):
    square, disc = sorted(scene.shapes, key=lambda shape: shape.emission is not None)
    assert scene.lights == ()
    np.testing.assert_allclose(disc.to_world[:3, 3], [0, 0, 110.1], atol=1e-3)
    np.testing.assert_allclose(np.linalg.norm(disc.to_world[:3, 0]), 0.01, rtol=1e-6)
    np.testing.assert_allclose(scene.camera.to_world[:3, 3], [0, 5, 5], atol=1e-9)
    np.testing.assert_allclose(-scene.camera.to_world[:3, 2], [0, -np.sqrt(0.5), -np.sqrt(0.5)], atol=1e-6)
    tilt = np.radians(-41.4)
    np.testing.assert_allclose(square.to_world[:3, 2], [0, -np.sin(tilt), np.cos(tilt)], atol=1e-6)


def test_a_radiance_test_of_ours_in_json_stands_where_it_says():
    builder = SceneBuilder()
    builder.plane("Reflector", material="White")
    builder.plane("AreaLight", material="Black", placement=Placement((0, 0, 10), (180, 0, 0)))
    builder.camera()
    document = Scene.parse(builder.tobytes(), "parent.dae")
    changes = [
        moved("Camera", "mexximpRotate([1 0 0], deg2rad((turn))) * mexximpTranslate([0 (y) (z)])"),
        moved("AreaLight", "mexximpScale([(r) (r) 1]) * mexximpTranslate([0 0 -(far) - 0.1]) * oldValue"),
        moved("Reflector", "mexximpRotate([1 0 0], deg2rad((tilt))) * oldValue"),
        {"name": "AreaLight", "broadType": "meshes", "operation": "blessAsAreaLight"},
    ]
    cells = {"turn": "-45", "y": "5", "z": "5", "r": "0.01", "far": "100", "tilt": "-41.4"}
    adjustments = filled(*changes, scene=document, **cells)
    check_radiance_test(resolve(document, adjustments, SceneSettings(Film(8, 8)), nothing).scene)
