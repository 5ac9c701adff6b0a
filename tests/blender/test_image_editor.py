"""Looking at renderings and probing them from a script, as the Image Editor does."""

import importlib

import bpy
import numpy as np
import pytest

from rtb_addon.colorimetry import xyz
from rtb_addon.layers import Layers
from rtb_addon.observers import lms
from rtb_addon.spectral_image import SpectralImage
from tests.blender.stand_in_layout import RecordingLayout

PATCHES = ("blue", "green")


@pytest.fixture(scope="module")
def module(extension):
    """Return a module of the extension as Blender has loaded it."""
    return lambda name: importlib.import_module(f"{extension}.{name}")


@pytest.fixture(scope="module")
def folder(module, tmp_path_factory):
    """Blender's default scene as a recipe of two conditions, rendered; the recipe's folder."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    bpy.data.materials["Material"].rtb.use_spectra = True
    bpy.data.materials["Material"].rtb.reflectance = "(paint)"
    bpy.data.lights["Light"].rtb.use_spectra = True
    rows = [[patch, f"BabelColor Average/{patch}"] for patch in PATCHES]
    module("rtb_addon.blender").set_conditions(scene, ["imageName", "paint"], rows)
    scene.rtb.renderer, scene.rtb.samples = "tracer", 2
    scene.rtb.width, scene.rtb.height = 24, 16
    home = tmp_path_factory.mktemp("image-editor")
    bpy.ops.wm.save_as_mainfile(filepath=str(home / "cube.blend"))
    bpy.ops.rtb.render_recipe()
    return home / "rtb/cube"


@pytest.fixture
def window_manager(folder, module):
    """The window manager, with no pins and the view as it begins; the viewer's process ends afterwards."""
    found = bpy.context.window_manager
    view = found.rtb_view
    yield found
    for name in ("condition", "kind", "other", "auto_scale", "renderer"):
        view.property_unset(name)
    module("operators.pins").clear()
    module("operators.viewing").forget()


def cube(folder, name: str) -> SpectralImage:
    return SpectralImage.load(folder / f"renderings/tracer/{name}.exr")


def shown() -> np.ndarray:
    """Return the picture that is shown, (height, width, 3), row 0 on top."""
    image = bpy.data.images["cube"]
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(height, width, 4)[::-1, :, :3]


def test_a_view_that_is_set_changes_the_one_image_there_is(folder, window_manager, module):
    viewing, view = module("operators.viewing"), window_manager.rtb_view
    viewing.show(folder)
    assert shown().shape == (16, 48, 3)
    view.kind, view.condition, view.auto_scale, view.full_luminance = "luminance", "green", False, 1e9
    assert shown().shape == (16, 24, 3)
    assert shown().max() < 0.01
    view.kind = "wavelength"
    view.auto_scale = True
    grey = shown()[..., 0]
    brightest = np.unravel_index(cube(folder, "green").radiance[..., 15].argmax(), grey.shape)
    assert grey[brightest] == 1
    assert [image.name for image in bpy.data.images if image.get("rtb_montage")] == ["cube"]
    assert not bpy.data.images["cube"].is_dirty
    assert bpy.data.images["cube"].filepath == "//rtb/cube/images/view.tif"


def test_what_cannot_be_shown_is_a_sentence_and_the_picture_stays(folder, window_manager, module):
    viewing = module("operators.viewing")
    viewing.show(folder)
    before = shown()
    window_manager.rtb_view.condition = "nobody"
    assert "no condition nobody" in viewing.sentence
    assert (shown() == before).all()
    window_manager.rtb_view.condition = ""
    assert viewing.sentence == ""


def test_a_probe_from_a_script_measures_what_the_file_holds(folder, window_manager, module):
    pins = module("operators.pins")
    assert bpy.ops.rtb.probe(condition="blue", region=(9, 6, 4, 3)) == {"FINISHED"}
    assert bpy.ops.rtb.probe(condition="green", region=(9, 6, 4, 3), compare=True) == {"FINISHED"}
    first, second = window_manager.rtb_pins
    assert [first.number, first.first, second.number, second.first] == [1, 0, 2, 1]
    for pin, name in ((first, "blue"), (second, "green")):
        image, probe = cube(folder, name), pins.probe_of(pin.words)
        pixels = image.radiance[6:9, 9:13].reshape(-1, 31).astype(float)
        np.testing.assert_allclose(probe.radiance, pixels.mean(axis=0))
        np.testing.assert_allclose(probe.standard_error, pixels.std(axis=0, ddof=1) / np.sqrt(12))
        np.testing.assert_allclose(probe.lms, lms(pixels.mean(axis=0), image.bands))
        assert probe.white == pytest.approx(xyz(image)[..., 1].max())


def test_a_region_that_is_not_there_is_refused_in_one_sentence(folder, window_manager):
    with pytest.raises(RuntimeError, match="24 x 16 pixels has no region"):
        bpy.ops.rtb.probe(condition="blue", region=(23, 0, 2, 1))
    assert len(window_manager.rtb_pins) == 0


def test_pins_are_removed_one_by_one_or_all_at_once(folder, window_manager):
    for column in (8, 9, 10):
        bpy.ops.rtb.probe(condition="blue", region=(column, 6, 1, 1))
    window_manager.rtb_active_pin = 1
    bpy.ops.rtb.remove_pin()
    assert [pin.number for pin in window_manager.rtb_pins] == [1, 3]
    bpy.ops.rtb.remove_pin(all=True)
    assert len(window_manager.rtb_pins) == 0
    assert not bpy.ops.rtb.copy_pins.poll()


def test_pins_go_to_a_file(folder, window_manager, tmp_path):
    bpy.ops.rtb.probe(condition="blue", region=(9, 6, 1, 1))
    assert bpy.ops.rtb.export_pins(filepath=str(tmp_path / "pins.csv")) == {"FINISHED"}
    lines = (tmp_path / "pins.csv").read_text().splitlines()
    assert lines[0] == "condition,blue,"
    assert lines[1] == "renderer,tracer,"
    assert len(lines) == 10 + 1 + 31


def test_standard_errors_are_asked_for_rendered_and_shown(folder, window_manager, module):
    viewing, view, settings = module("operators.viewing"), window_manager.rtb_view, bpy.context.scene.rtb
    viewing.show(folder)
    view.kind = "error"
    assert "Layers" in viewing.sentence
    settings.layers = {"standard_error"}
    bpy.ops.rtb.render_condition(condition="green")
    view.condition = "green"
    assert viewing.sentence == ""
    errors = Layers.load(folder / "layers/tracer/green.exr").planes["standard_error"]
    assert viewing.seen["full"] == pytest.approx(np.sqrt((errors**2).mean(axis=2)).max(), rel=1e-5)
    settings.layers = set()


def test_undo_leaves_the_picture_in_its_image_editor(folder, window_manager, module):
    scene, viewing = bpy.context.scene, module("operators.viewing")
    bpy.data.images.remove(bpy.data.images["cube"])  # what undo goes back to knows no picture
    bpy.ops.ed.undo_push(message="before")
    scene.frame_current = 7
    bpy.ops.ed.undo_push(message="frame")
    area = window_manager.windows[0].screen.areas[0]
    kind, area.type = area.type, "IMAGE_EDITOR"
    viewing.show(folder)
    area.spaces.active.image = bpy.data.images["cube"]
    bpy.ops.ed.undo()
    assert bpy.context.scene.frame_current != 7
    assert area.spaces.active.image == bpy.data.images["cube"]
    assert shown().shape == (16, 48, 3)
    area.type = kind


def test_a_recipe_of_another_scene_is_not_taken_for_this_ones(folder, window_manager, module):
    viewing = module("operators.viewing")
    viewing.show(folder)
    assert viewing.shows(bpy.context.scene)
    bpy.context.scene.rtb.name = "another"
    assert not viewing.shows(bpy.context.scene)
    layout = drawn(module, "rendering", "RTB_PT_rendering")
    assert layout.names("operator") == ["rtb.show_montage"]
    assert layout.names("prop") == []
    bpy.context.scene.rtb.name = ""


def test_the_montage_is_arranged_as_the_scene_says(folder, window_manager, module):
    viewing, settings = module("operators.viewing"), bpy.context.scene.rtb
    settings.montage_columns = 1
    viewing.show(folder)
    assert shown().shape == (32, 24, 3)
    settings.montage_columns = 0


def test_what_render_image_has_rendered_is_looked_at_and_probed(folder, window_manager, module, monkeypatch):
    viewing, scene = module("operators.viewing"), bpy.context.scene
    monkeypatch.setattr(scene.render, "engine", "RENDERTOOLBOX")
    with pytest.raises(RuntimeError, match="press F12"):
        bpy.ops.rtb.show_still()
    bpy.ops.render.render()
    assert bpy.ops.rtb.show_still() == {"FINISHED"}
    assert viewing.shows(scene)
    assert not viewing.shows_recipe(scene)
    assert viewing.seen["name"] == "cube still"
    bpy.ops.rtb.probe(condition="blue", region=(9, 6, 4, 3))
    still = SpectralImage.load(folder / "still/renderings/tracer/blue.exr").radiance[6:9, 9:13]
    probe = module("operators.pins").probe_of(window_manager.rtb_pins[0].words)
    np.testing.assert_allclose(probe.radiance, still.reshape(-1, 31).astype(float).mean(axis=0))
    window_manager.rtb_view.kind = "luminance"
    assert viewing.seen["folder"] == str(folder / "still")


def test_a_pin_is_drawn_only_where_the_picture_shows_what_it_measured(folder, window_manager, module):
    viewing, pins = module("operators.viewing"), module("operators.pins")
    viewing.show(folder)
    bpy.ops.rtb.probe(condition="blue", region=(9, 6, 4, 3))
    pin = window_manager.rtb_pins[0]
    assert pins.is_seen(pin)
    window_manager.rtb_view.condition = "green"
    assert not pins.is_seen(pin)
    window_manager.rtb_view.condition = ""
    pin.folder = "elsewhere"
    assert not pins.is_seen(pin)


def drawn(module, name: str, kind: str) -> RecordingLayout:
    """Let a panel draw into a stand-in."""
    panel, layout = getattr(module(f"panels.{name}"), kind), RecordingLayout()
    stand_in = type(kind, (), {"draw": panel.draw, "layout": layout})()
    region = type("Region", (), {"width": 250})
    space = type("Space", (), {"image": None})
    seen = {name: getattr(bpy.context, name) for name in ("scene", "window_manager", "preferences")}
    stand_in.draw(type("Context", (), {**seen, "region": region, "space_data": space}))
    return layout


def test_the_panels_draw_what_there_is(folder, window_manager, module):
    module("operators.viewing").show(folder)
    assert drawn(module, "rendering", "RTB_PT_rendering").names("prop") == [
        *("condition", "kind", "auto_scale", "renderer")
    ]
    window_manager.rtb_view.kind = "difference"
    layout = drawn(module, "rendering", "RTB_PT_rendering")
    assert layout.names("prop") == ["condition", "kind", "other", "auto_scale", "renderer"]
    assert "choose one" in " ".join(layout.names("label"))
    bpy.ops.rtb.probe(condition="blue", region=(9, 6, 2, 2))
    bpy.ops.rtb.probe(condition="green", region=(9, 6, 2, 2), compare=True)
    layout = drawn(module, "probes", "RTB_PT_probes")
    assert layout.names("list") == ["RTB_UL_pins"]
    assert {"Luminance", "CIE xy", "LMS", "ΔE 2000", "LMS Contrast"} <= set(layout.names("label"))


def test_before_anything_is_rendered_the_panel_offers_to_show_the_montage(window_manager, module):
    module("operators.viewing").forget()
    assert drawn(module, "rendering", "RTB_PT_rendering").names("operator") == ["rtb.show_montage"]


def test_opening_a_file_forgets_pins_and_ends_the_viewer(folder, window_manager, module):
    viewing = module("operators.viewing")
    viewing.show(folder)
    bpy.ops.rtb.probe(condition="blue", region=(9, 6, 1, 1))
    child = viewing._child._child
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    assert len(bpy.context.window_manager.rtb_pins) == 0
    assert not viewing.seen
    assert child.poll() is not None


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ((0.0049, 0.00218, 0.000883), ("4.9 2.18 0.883", "m")),
        ((1e-6, 2e-6, 3e-6), ("1 2 3", "µ")),
        ((12.0, 0.5, 0.0), ("12 0.5 0", "")),
        ((0.0, 0.0, 0.0), ("0 0 0", "")),
        ((1234.0, 1e20, 0.0), ("1.23e-06 1e+11 0", "G")),
    ],
)
def test_numbers_of_one_unit_are_short_and_its_prefix_is_said(module, values, expected):
    assert module("panels.numbers").in_prefix(values) == expected
