"""A change in Blender is the same as by a mapping or a row."""

import bpy
import numpy as np
import pytest

# A row applied in Blender and then exported, or exported and then applied by the mappings


def moved(body):
    body.location = (1.25, -2, 0.75)


def turned(body):
    body.rotation_euler = tuple(np.radians((10, 20, 30)))


def scaled(body):
    body.scale = (2, 0.5, -1)


EDITS = {
    "location": (moved, "Below:translate|sid=location = 1.25 -2 0.75"),
    "rotation": (
        turned,
        "Below:rotate|sid=rotationX = 1 0 0 10\nBelow:rotate|sid=rotationY = 0 1 0 20\n"
        "Below:rotate|sid=rotationZ = 0 0 1 30",
    ),
    "scale": (scaled, "Below:scale|sid=scale = 2 0.5 -1"),
}


@pytest.mark.parametrize("edit", EDITS)
def test_a_move_in_blender_is_the_same_as_by_a_mapping(still, box, resolved, edit):
    above = box("Above", location=(3, 2, 1), scale=(2, 2, 2), rotation_euler=(0.5, 0, 1))
    box("Below", location=(0, 1, 0), rotation_euler=(0.1, 0.2, 0.3), scale=(1, 2, 3)).parent = above
    act, lines = EDITS[edit]
    mapped = resolved(still, mappings=f"Collada {{\n{lines}\n}}\n")
    act(bpy.data.objects["Below"])
    exported = resolved(still)
    corners = [
        np.concatenate(
            [
                each.mesh.vertices[each.mesh.triangles].reshape(-1, 3) @ each.to_world[:3, :3].T
                + each.to_world[:3, 3]
                for each in scene.shapes
            ]
        )
        for scene in (mapped, exported)
    ]
    np.testing.assert_allclose(*corners, rtol=1e-6, atol=1e-6)
    assert not np.allclose(corners[0], 0)


def test_a_spectrum_in_blender_is_the_same_as_by_a_row(still, resolved, library):
    material, light = bpy.data.materials["Paint"].rtb, bpy.data.lights["Lamp"].rtb
    texts = {"paint": "BabelColor Average/orange", "light": "blackbody 3000"}
    library("blender").set_conditions(still, ["imageName", *texts], [["row", *texts.values()]])
    material.reflectance, light.spectrum = "(paint)", "(light)"
    mapped = resolved(still, "row")
    material.reflectance, light.spectrum = texts.values()
    exported = resolved(still, "row")
    for read in (
        lambda scene: scene.materials["Paint-material"].parameters["diffuseReflectance"],
        lambda scene: scene.lights[0].parameters["intensity"],
    ):
        np.testing.assert_array_equal(read(mapped).values, read(exported).values)
        assert np.ptp(read(mapped).values) > 0


def test_a_lamps_power_in_blender_is_the_same_as_by_a_mapping(still, resolved):
    light = bpy.data.lights["Lamp"]
    light.rtb.spectrum, light.energy = "1", 470 * 4 * np.pi
    lines = "Lamp-light:intensity.spectrum = 300:2 800:2"
    mapped = resolved(still, mappings=f"Generic {{\n{lines}\n}}\n").lights[0]
    light.energy *= 2
    exported = resolved(still).lights[0]
    wavelengths = np.arange(360, 831, 10)
    np.testing.assert_allclose(
        mapped.parameters["intensity"].at(wavelengths),
        exported.parameters["intensity"].at(wavelengths),
        rtol=1e-6,
    )
