"""What panels draw, without a window: a stand-in notes it."""

import importlib
import sys
from types import SimpleNamespace

import bpy
import pytest

from rtb_addon.layers import NAMES
from tests.blender.stand_in_layout import RecordingLayout


@pytest.fixture
def panel(extension):
    """Return a function that lets a panel draw into a stand-in and returns what was drawn."""
    bpy.ops.wm.read_homefile(use_factory_startup=True)

    def drawn(module: str, name: str, **context) -> RecordingLayout:
        kind = getattr(sys.modules[f"{extension}.panels.{module}"], name)
        layout = RecordingLayout()
        attributes = {key: getattr(kind, key) for base in kind.__mro__ for key in vars(base) if key[0] != "_"}
        stand_in = type(name, (), {**attributes, "layout": layout})()
        seen = SimpleNamespace(
            scene=bpy.context.scene,
            region=SimpleNamespace(width=250),
            preferences=bpy.context.preferences,
            **context,
        )
        assert not hasattr(kind, "poll") or kind.poll(seen)
        stand_in.draw(seen)
        return layout

    return drawn


@pytest.fixture
def running(extension):
    """The module that knows the batch; nothing runs and nothing was found."""
    module = sys.modules[f"{extension}.operators.running"]
    findings = sys.modules[f"{extension}.operators.findings"]
    findings.clear()
    yield SimpleNamespace(module=module, findings=findings)
    module.batch = None
    findings.clear()


def batch(**said):
    """Return what stands for a batch that is under way."""
    usual = {"progress": 0.25, "finished": 3, "total": 12, "remaining": 74.6, "cancelled": False}
    usual["under_way"] = {"blue": 0.5}
    return SimpleNamespace(**{**usual, **said})


def test_the_recipes_panel_offers_what_can_be_done(panel, running):
    layout = panel("recipe", "RTB_PT_recipe")
    assert layout.names("operator") == [
        *("rtb.render_recipe", "rtb.render_condition", "rtb.check_recipe"),
        *("rtb.show_montage", "rtb.compare_renderers", "rtb.open_folder", "rtb.pack_recipe"),
    ]
    assert layout.names("prop") == ["name", "folder"]


@pytest.mark.parametrize(
    ("said", "text"),
    [
        ({}, "3/12 · 1:15 left"),
        ({"remaining": None}, "3/12"),
        ({"remaining": 3725.0}, "3/12 · 1:02:05 left"),
        ({"total": 0}, "Starting…"),
        ({"cancelled": True}, "Stopping…"),
    ],
)
def test_a_running_batch_shows_how_far_it_is_and_can_be_cancelled(panel, running, said, text):
    running.module.batch = batch(**said)
    layout = panel("recipe", "RTB_PT_recipe")
    assert layout.names("progress") == [text, "blue"]
    assert layout.names("operator")[0] == "rtb.cancel_rendering"
    assert "rtb.render_recipe" not in layout.names("operator")


def test_a_sentence_is_drawn_whole_on_lines_that_fit(panel, running):
    sentence = "conditions.txt:4: 3 values for 4 variables (imageName, light, paint, gloss)"
    running.findings.errors.append(sentence)
    lines = panel("recipe", "RTB_PT_recipe").names("label")
    assert " ".join(lines) == sentence
    assert max(map(len, lines)) < 32


def test_many_errors_do_not_push_the_panel_off_the_screen(panel, running):
    running.findings.errors.extend(f"condition {number} failed" for number in range(40))
    labels = panel("recipe", "RTB_PT_recipe").names("label")
    assert len(labels) == 7
    assert "34 more" in labels[-1]


def test_how_the_montage_is_arranged_stands_beside_it(panel, running):
    assert panel("rendering", "RTB_PT_montage").names("prop") == ["montage_columns", "montage_fill"]


@pytest.mark.parametrize("engine", ["CYCLES", "RENDERTOOLBOX"])
def test_how_to_render_stands_in_the_render_tab_whatever_the_engine(panel, engine):
    bpy.context.scene.render.engine = engine
    layout = panel("render_settings", "RTB_PT_render_settings")
    assert layout.names("prop") == [
        *("renderer", "samples", "until_error", "bands_count", "bands_start", "bands_step"),
        *("layers", "integrator", "depth", "seed", "filter", "band_kind"),
    ]
    assert ("view transform" in " ".join(layout.names("label"))) == (engine == "RENDERTOOLBOX")


def test_every_layer_can_be_chosen(extension):
    offered = importlib.import_module(f"{extension}.rtb_addon.blender.properties").LAYERS
    assert tuple(name for name, *_ in offered) == NAMES


SPECTRAL = [
    (
        "spectral_material",
        "RTB_PT_spectral_material",
        "material",
        ["model", "reflectance", "kind", "detail", "opacity"],
    ),
    ("spectral_light", "RTB_PT_spectral_light", "light", ["spectrum", "measure", "energy"]),
    ("spectral_world", "RTB_PT_spectral_world", "world", ["kind", "spectrum", "measure", "amount"]),
]


def thing_of(kind: str):
    """Return the default scene's material, light or world."""
    return {
        "material": bpy.data.materials["Material"],
        "light": bpy.data.lights["Light"],
        "world": bpy.context.scene.world,
    }[kind]


@pytest.mark.parametrize(("module", "name", "kind", "properties"), SPECTRAL)
def test_a_thing_without_spectra_shows_one_button(panel, module, name, kind, properties):
    layout = panel(module, name, **{kind: thing_of(kind)})
    assert layout.names("operator") == ["rtb.use_spectra"]
    assert not layout.names("prop")


@pytest.mark.parametrize(("module", "name", "kind", "properties"), SPECTRAL)
def test_a_thing_with_spectra_shows_them(panel, module, name, kind, properties):
    thing_of(kind).rtb.use_spectra = True
    assert panel(module, name, **{kind: thing_of(kind)}).names("prop") == ["use_spectra", *properties]


def test_a_mesh_shows_what_it_sends_out(panel):
    cube = bpy.data.objects["Cube"]
    layout = panel("spectral_emission", "RTB_PT_spectral_emission", object=cube, mesh=cube.data)
    assert layout.names("prop") == ["spectrum", "emission", "amount"]
