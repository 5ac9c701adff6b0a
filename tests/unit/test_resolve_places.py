"""Parent scenes made into the neutral scene: where things stand."""

import numpy as np
import pytest

from rtb_addon.errors import RecipeError
from tests.unit.small_rooms import CAMERA, LAMP, resolved, wall, wall_matrix, with_nodes, world_area

# Where things stand.


@pytest.mark.parametrize(
    ("transforms", "point", "expected"),
    [
        ("<translate>1 2 3</translate>", (0, 0, 0), (1, 2, 3)),
        ("<rotate>0 0 1 90</rotate>", (1, 0, 0), (0, 1, 0)),
        ("<rotate>2 0 0 90</rotate>", (0, 1, 0), (0, 0, 1)),
        ("<scale>2 3 4</scale>", (1, 1, 1), (2, 3, 4)),
        ("<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>", (1, 0, 0), (5, 7, 7)),
        ("<translate>1 0 0</translate><rotate>0 0 1 90</rotate><scale>2 1 1</scale>", (1, 0, 0), (1, 2, 0)),
        (
            "<matrix>1 0 0 0 0 1 0 0 0 0 1 10 0 0 0 1</matrix><translate>4 -5 0</translate>",
            (0, 0, 0),
            (4, -5, 10),
        ),
        ("<lookat>0 0 5 0 0 0 0 1 0</lookat>", (1, 2, -1), (1, 2, 4)),
        ("<lookat>5 0 0 0 0 0 0 0 1</lookat>", (0, 0, -5), (0, 0, 0)),
        ("<lookat>5 0 0 0 0 0 0 0 1</lookat>", (0, 1, 0), (5, 0, 1)),
        ("<skew>45 0 1 0 1 0 0</skew>", (0, 2, 0), (2, 2, 0)),
        ("<skew>45 0 1 0 1 0 0</skew>", (3, 0, 1), (3, 0, 1)),
        # An axis half-way to the other one and 15 degrees more of it.
        ("<skew>15 0 0 1 0 1 0 </skew>", (0, 0, 1), (0, 0.2679491924311227, 1)),
        ("<skew>15 0 1 1 0 1 0 </skew>", (0, 0, 1), (0, 0.7320508075688772, 1)),
    ],
)
def test_every_transform_acts_in_its_turn(transforms, point, expected):
    np.testing.assert_allclose((wall_matrix(transforms) @ [*point, 1])[:3], expected, atol=1e-12)


@pytest.mark.parametrize(
    ("transforms", "words"),
    [
        ("<skew>30 0 1 0 0 2 0</skew>", "must not be parallel, in the node Wall"),
        ("<skew>90 0 1 0 1 0 0</skew>", "turns its axis too far"),
        ("<skew>30 0 0 0 1 0 0</skew>", "a skew needs two axes"),
        ("<scale>2</scale>", "a scale holds 1 numbers, want 3, in the node Wall"),
        ("<rotate>0 0 0 30</rotate>", "needs an axis"),
        ("<lookat>0 0 1 0 0 0 0 0 1</lookat>", "a direction up"),
    ],
)
def test_a_transform_that_makes_no_sense_is_refused(transforms, words):
    with pytest.raises(RecipeError, match=words):
        wall_matrix(transforms)


def test_nodes_stand_where_all_their_parents_put_them():
    inner = wall("<translate>1 0 0</translate>", id="Inner")
    outer = f'<node id="Outer"><translate>0 0 2</translate><rotate>0 0 1 90</rotate>{inner}</node>'
    scene = resolved(with_nodes(CAMERA + LAMP + outer)).scene
    np.testing.assert_allclose(scene.shapes[0].to_world[:3, 3], [0, 1, 2], atol=1e-12)


def test_nodes_of_a_library_stand_wherever_they_are_used():
    library = f"<library_nodes>{wall('<translate>1 0 0</translate>', id='Kept')}</library_nodes>"
    uses = "".join(
        f'<node id="{name}"><translate>0 {y} 0</translate><instance_node url="#Kept"/></node>'
        for name, y in (("A", 3), ("B", 4))
    )
    shapes = resolved(with_nodes(CAMERA + LAMP + uses, library=library)).scene.shapes
    assert [shape.id for shape in shapes] == ["Wall-mesh_0", "Wall-mesh_1"]
    np.testing.assert_allclose([shape.to_world[:3, 3] for shape in shapes], [[1, 3, 0], [1, 4, 0]])
    assert shapes[0].mesh is shapes[1].mesh


def test_a_node_that_holds_itself_is_refused():
    loop = '<node id="Loop"><instance_node url="#Loop"/></node>'
    with pytest.raises(RecipeError, match="the node Loop holds itself"):
        resolved(with_nodes(CAMERA + LAMP + loop))


def test_centimetres_with_y_up_are_metres_with_z_up():
    metres = CAMERA + LAMP + wall("<translate>1 2 3</translate><rotate>1 0 0 30</rotate>")
    turn = "<rotate>1 0 0 -90</rotate><scale>100 100 100</scale>"
    centimetres = f'<node id="World">{turn}{metres}</node>'
    here, there = (
        resolved(with_nodes(nodes, unit, up)).scene
        for nodes, unit, up in ((metres, "1", "Z_UP"), (centimetres, "0.01", "Y_UP"))
    )
    np.testing.assert_allclose(there.shapes[0].to_world, here.shapes[0].to_world, atol=1e-12)
    np.testing.assert_allclose(there.camera.to_world, here.camera.to_world, atol=1e-12)
    np.testing.assert_allclose(there.lights[0].to_world, here.lights[0].to_world, atol=1e-12)
    assert there.camera.window == pytest.approx(here.camera.window)


@pytest.mark.parametrize(
    ("up", "point", "expected"),
    [("Y_UP", (1, 2, 3), (1, -3, 2)), ("X_UP", (1, 2, 3), (-2, -3, 1)), ("Z_UP", (1, 2, 3), (1, 2, 3))],
)
def test_what_is_up_in_the_document_is_up_in_the_world(up, point, expected):
    np.testing.assert_allclose((wall_matrix("", up=up) @ [*point, 1])[:3], expected)


def test_a_mirrored_object_shows_its_front_and_no_mirroring_matrix():
    straight, mirrored = (
        resolved(with_nodes(CAMERA + LAMP + wall(f"<scale>{x} 1 1</scale><rotate>1 0 0 20</rotate>"))).scene
        for x in (1, -1)
    )
    shape = mirrored.shapes[0]
    assert np.linalg.det(shape.to_world[:3, :3]) > 0
    np.testing.assert_allclose(world_area(shape), world_area(straight.shapes[0]) * [-1, 1, 1], atol=1e-6)


def test_an_object_scaled_to_nothing_is_left_out_and_said():
    found = resolved(with_nodes(CAMERA + LAMP + wall("<scale>1 1 0</scale>", id="Gone") + wall()))
    assert len(found.scene.shapes) == 1
    assert "Gone is scaled to nothing and left out" in found.warnings
