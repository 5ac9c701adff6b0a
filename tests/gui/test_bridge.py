"""The bridge in a real Blender 5: working spaces, properties, the scene as it renders."""

import pytest

SCRIPT = "in_bridge.py"
COLOURS = {
    "material": (0.8, 0.2, 0.1),
    "light": (0.3, 0.9, 0.5),
    "temperature": (1.7708408, 0.8442848, 0.2722227),
}


@pytest.mark.parametrize("space", ["Linear Rec.709", "Linear Rec.2020", "ACEScg"])
@pytest.mark.parametrize("what", COLOURS)
def test_colours_are_rec709_whatever_space_blender_works_in(report, space, what):
    found = report["colours"][space]
    assert found["working"] == space
    assert found[what] == pytest.approx(COLOURS[what], abs=1e-5)


def test_a_saved_and_reopened_scene_is_the_same_recipe(report):
    assert report["recipe"]["same"]
    assert report["recipe"]["rows"] == [["dark", "0.1"], ["light", "0.8"]]


def test_the_scene_is_read_as_it_renders_and_left_alone(report):
    assert report["recipe"]["triangles"] == 1, "the cube is subdivided twice in renders only"
    assert report["recipe"]["scenes"] == ["Scene"]
    assert not [sentence for sentence in report["recipe"]["report"] if "nodes" in sentence]
    for line in ("Area-mesh:light:area", "Light-light:light:point", "diffuseReflectance.spectrum = (paint)"):
        assert line in report["recipe"]["mappings"]


def test_what_a_function_does_for_each_condition_is_baked_and_taken_back(report):
    baked = report["baked"]
    assert baked["cells"] == [
        *("parent.dae", "resources/parent-two.dae", "resources/parent-gone.dae", "resources/parent-two.dae")
    ]
    assert baked["cubes"] == [True, True, True, False, True]
    assert baked["same"]
    assert (baked["frame"], baked["objects"], baked["meshes"]) == (1, ["Camera", "Cube", "Light"], ["Cube"])


def test_undo_and_redo_reach_our_properties(report):
    assert report["undone"] == ["0.5", "0.9", "0.5", "0.9"]
