"""Check, render one condition, pack, compare: every button of the recipe's panel from a script."""

import subprocess
import sys
import zipfile
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest

from tests.blender.test_operators import sentence_of
from tests.conftest import PLUGIN

CUBE = Path("rtb/cube/renderings/tracer")


@pytest.fixture
def scene(family):
    """A recipe of two conditions that is quickly rendered."""
    return family


@pytest.fixture
def findings(module):
    """The module that knows what was found last."""
    found = module("operators.findings")
    found.clear()
    yield found
    found.clear()


def cubes(folder: Path) -> list[str]:
    return sorted(each.stem for each in (folder / CUBE).glob("*.exr"))


def test_check_finds_everything_at_once_and_what_each_finding_is_about(scene, findings):
    scene.rtb.conditions[0].cells[0].value = "BabelColor Average/blew"
    scene.rtb.conditions[1].cells[0].value = ""
    bpy.data.lights["Light"].rtb.spectrum = "D64"
    bpy.data.meshes["Cube"].materials.clear()
    bpy.data.objects["Cube"].material_slots.update()
    assert bpy.ops.rtb.check_recipe() == {"FINISHED"}
    about = {(culprit.kind, culprit.name) for culprit in findings.culprits.values()}
    assert about == {("light", "Light"), ("object", "Cube")}, "without material nobody asks for its spectrum"
    bpy.data.meshes["Cube"].materials.append(bpy.data.materials["Material"])
    bpy.ops.rtb.check_recipe()
    about = {(culprit.kind, culprit.name) for culprit in findings.culprits.values()}
    assert about == {("light", "Light"), ("condition", "blue"), ("condition", "green")}


def test_what_only_the_written_recipe_shows_is_found_too(scene, findings):
    scene.rtb.mappings_text = bpy.data.texts.new("Mappings")
    scene.rtb.mappings_text.write("Generic {\n    Material-material:material:matt\n}\n")
    bpy.ops.rtb.check_recipe()
    assert len(findings.errors) == 1
    assert "matt" in findings.errors[0]
    culprit = findings.culprits[findings.errors[0]]
    assert (culprit.kind, culprit.name) == ("line", "2")


def test_a_good_recipe_has_no_problems(scene, findings):
    assert bpy.ops.rtb.check_recipe() == {"FINISHED"}
    assert findings.errors == []
    assert findings.remarks


def test_a_culprit_is_selected(scene, findings):
    for kind, name in (("LIGHT", "Light"), ("MATERIAL", "Material"), ("OBJECT", "Camera")):
        bpy.ops.rtb.select_culprit(kind=kind, name=name)
        active = bpy.context.view_layer.objects.active
        assert active.name == {"MATERIAL": "Cube"}.get(kind, name)
        assert [each.name for each in bpy.context.selected_objects] == [active.name]
    bpy.ops.rtb.select_culprit(kind="CONDITION", name="green")
    assert scene.rtb.active_condition == 1
    assert "no condition" in sentence_of(bpy.ops.rtb.select_culprit, kind="CONDITION", name="gone")


def test_one_condition_is_rendered_alone(scene, tmp_path):
    scene.rtb.active_condition = 1
    assert bpy.ops.rtb.render_condition() == {"FINISHED"}
    assert cubes(tmp_path) == ["green"]
    assert bpy.ops.rtb.render_condition(condition="blue") == {"FINISHED"}
    assert cubes(tmp_path) == ["blue", "green"]
    assert "gone" in sentence_of(bpy.ops.rtb.render_condition, condition="gone")


@pytest.mark.parametrize("name", ["dark, wet", "-5", "a;b", "it's"])
def test_whatever_a_condition_is_called_it_is_rendered_alone(scene, tmp_path, name):
    scene.rtb.conditions[1].name = name
    assert bpy.ops.rtb.render_condition(condition=name) == {"FINISHED"}
    assert cubes(tmp_path) == [name]


def test_a_packed_recipe_renders_elsewhere(scene, module, tmp_path):
    assert bpy.ops.rtb.pack_recipe(filepath=str(tmp_path / "cube.zip")) == {"FINISHED"}
    names = zipfile.ZipFile(tmp_path / "cube.zip").namelist()
    assert {"recipe.json", "parent.dae", "conditions.txt"} <= set(names)
    unpack = module("rtb_addon.recipe.unpacking").unpack_recipe
    recipe = unpack(tmp_path / "cube.zip", tmp_path / "elsewhere")
    assert [row.name for row in recipe.conditions] == ["blue", "green"]


def test_renderers_are_tested_and_compared(scene, findings, module):
    assert bpy.ops.rtb.test_renderers() == {"FINISHED"}
    found = module("operators.renderers_found").found
    assert found["tracer"].version
    assert found["mitsuba"].version
    for renderer in ("tracer", "mitsuba"):
        scene.rtb.renderer = renderer
        bpy.ops.rtb.render_recipe()
    assert bpy.ops.rtb.compare_renderers(first="mitsuba", second="tracer") == {"FINISHED"}
    assert any(each.startswith("blue: the means' ratio is") for each in findings.remarks)
    assert tuple(bpy.data.images["cube mitsuba-tracer"].size) == (2 * 24, 16)


def test_comparing_says_what_is_to_be_rendered_first(scene, findings):
    assert "press Render Recipe" in sentence_of(bpy.ops.rtb.compare_renderers)
    bpy.ops.rtb.render_recipe()
    assert "blue is not rendered with mitsuba yet" in sentence_of(bpy.ops.rtb.compare_renderers)


@pytest.mark.parametrize("renderer", ["tracer", "mitsuba"])
def test_a_button_a_script_and_the_command_line_render_the_same_cubes_bit_for_bit(
    scene, module, tmp_path, renderer
):
    scene.rtb.renderer = renderer
    bpy.ops.rtb.render_recipe()
    library = module("rtb_addon.blender")
    scripted = library.read_recipe(scene).save(tmp_path / "scripted")
    typed = library.read_recipe(scene).save(tmp_path / "typed")
    module("rtb_addon.batch.execute").execute_recipe(scripted)
    command = [sys.executable, "-m", "rtb_addon", "render", str(typed)]
    subprocess.run(command, check=True, capture_output=True)
    read = module("rtb_addon.spectral_image").SpectralImage.load
    for name in ("blue", "green"):
        clicked, *others = (
            read(folder / "renderings" / renderer / f"{name}.exr").radiance
            for folder in (tmp_path / "rtb/cube", scripted, typed)
        )
        for other in others:
            np.testing.assert_array_equal(clicked, other)


def test_blenders_own_command_line_runs_ours(extension, module, capfd, tmp_path, scene):
    run = module("operators.command").run
    assert run(["renderers"]) == 0
    assert "tracer" in capfd.readouterr().out
    assert run(["check", str(tmp_path)]) == 2
    assert "no recipe folder" in capfd.readouterr().err
    assert run(["paint"]) == 2
    assert capfd.readouterr().err.startswith("usage: blender --command rtb")


def test_every_buttons_tooltip_says_how_a_script_does_the_same(scene, module):
    kind = bpy.ops.rtb.render_condition.get_rna_type()
    for condition, call in (("", "()"), ("blue", "(condition='blue')")):
        button = SimpleNamespace(
            bl_rna=SimpleNamespace(properties=list(kind.properties)),
            is_property_set=lambda name, condition=condition: bool(condition) and name == "condition",
            condition=condition,
        )
        said = module("operators.render_condition").RTB_OT_render_condition.description(bpy.context, button)
        assert said.startswith("Write the recipe and render one condition")
        assert said.endswith(f"Python: bpy.ops.rtb.render_condition{call}")
    for each in module("operators").CLASSES:
        if hasattr(each, "execute"):
            assert each.description.__func__ is module("operators.call_tooltips").describe


def test_preferences_reach_new_files_and_the_command_line(extension, module):
    preferences = module("operators.preferred")
    chosen = preferences.preferences()
    chosen.renderer, chosen.workers = "tracer", 3
    try:
        bpy.ops.wm.read_homefile(use_factory_startup=True)
        assert bpy.context.scene.rtb.renderer == "tracer"
        assert preferences.arguments() == ["--jobs", "3"]
    finally:
        for name in ("renderer", "workers"):
            chosen.property_unset(name)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert bpy.context.scene.rtb.renderer == "mitsuba"
    assert preferences.arguments() == []


def test_a_folder_that_is_not_there_yet_is_not_opened(scene):
    assert "press Render Recipe" in sentence_of(bpy.ops.rtb.open_folder)


def test_renderers_of_other_packages_are_found_where_the_preferences_point_chosen_and_remembered(
    scene, module
):
    chosen = module("operators.preferred").preferences()
    chosen.renderers = str(PLUGIN)
    try:
        bpy.ops.rtb.test_renderers()
        assert module("operators.renderers_found").found["plain"].version
        assert chosen.others == "plain"
        scene.rtb.renderer = "plain"
        assert bpy.ops.rtb.render_recipe() == {"FINISHED"}
        cubes = Path(bpy.path.abspath("//rtb/cube/renderings/plain"))
        assert sorted(each.stem for each in cubes.glob("*.exr")) == ["blue", "green"]
    finally:
        chosen.renderers = chosen.others = ""


def test_a_renderer_that_is_not_known_any_more_is_said(scene, module, monkeypatch):
    choices = module("rtb_addon.blender.renderer_choices")
    choices.learn(["gone"])
    scene.rtb.renderer = "gone"
    monkeypatch.setattr(choices, "_offered", [*choices.RENDERERS])
    assert "the renderer of the scene Scene is not known here" in sentence_of(bpy.ops.rtb.render_recipe)
