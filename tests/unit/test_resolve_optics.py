"""Lenses of some width, indices that vary with the wavelength, and slopes of rough surfaces, resolved."""

import numpy as np
import pytest

from rtb_addon.conditions import Condition
from rtb_addon.errors import RecipeError
from rtb_addon.mappings import parse_mappings
from rtb_addon.renderers.fidelity import unsupported
from rtb_addon.scene.build import SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve
from rtb_addon.spectra import Spectrum


def room(mappings="", lens=None, meter=1.0):
    builder = SceneBuilder(meter=meter)
    builder.camera(lens=lens)
    builder.point("Lamp")
    builder.plane("Pane", material="Pane")
    document = Scene.parse(builder.tobytes(), "room.dae")
    condition = Condition("room", {}, 1)
    filled = parse_mappings(mappings, "room.txt").fill_in(condition, "tracer", document, lambda name: None)
    return resolve(document, filled, SceneSettings(Film(4, 4)), lambda name: None).scene


def glass(*lines):
    inside = "".join(f"    Pane-material:{line}\n" for line in lines)
    return f"Generic {{\n{inside}}}\n"


def test_a_camera_is_a_pinhole_unless_it_says_otherwise():
    assert room().camera.lens_radius == 0


def test_a_lens_is_in_metres_whatever_the_unit_of_the_document():
    camera = room(lens=(2.0, 150.0), meter=0.01).camera
    np.testing.assert_allclose([camera.lens_radius, camera.focus_distance], [0.02, 1.5])


def test_a_mapping_stops_a_lens_down():
    path = "Camera-camera:extra:technique|profile=RenderToolbox:lens_radius"
    camera = room("Collada {\n    " + path + " = 0.01\n}\n", lens=(0.1, 3.0)).camera
    assert (camera.lens_radius, camera.focus_distance) == (0.01, 3.0)


@pytest.mark.parametrize("lens", [(-0.1, 2.0), (0.1, 0.0)])
def test_a_lens_that_makes_no_sense_is_refused(lens):
    with pytest.raises(RecipeError, match="the camera Camera has a lens of radius"):
        room(lens=lens)


def test_a_renderer_without_lenses_says_so():
    said = unsupported(room(lens=(0.1, 2.0)), "sphere")
    assert "camera Camera has a lens of some width, which sphere cannot render; give it a plain value" in said


def test_an_index_may_be_a_number_or_a_spectrum():
    plain = room(glass("material:glass", "intIOR.float = 1.6")).materials["Pane-material"]
    assert plain.parameters["intIOR"] == 1.6
    split = room(glass("material:glass", "intIOR.spectrum = 400:1.6 700:1.5")).materials["Pane-material"]
    assert isinstance(split.parameters["intIOR"], Spectrum)
    np.testing.assert_allclose(split.parameters["intIOR"].at([400, 550]), [1.6, 1.55])


def test_slopes_are_of_a_known_kind():
    made = room(glass("material:roughplastic", "distribution.string = ggx")).materials["Pane-material"]
    assert made.parameters["distribution"] == "ggx"
    assert (
        room(glass("material:roughplastic")).materials["Pane-material"].parameters["distribution"]
        == "beckmann"
    )
    with pytest.raises(RecipeError, match="is phong, want one of beckmann, ggx"):
        room(glass("material:roughplastic", "distribution.string = phong"))
