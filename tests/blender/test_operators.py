"""What the user can do: every operator from a script, as the panel's buttons call it."""

import os
import subprocess
import sys
from pathlib import Path

import bpy
import pytest

PATCHES = ("blue", "green")


@pytest.fixture
def scene(family):
    """A recipe of two conditions that is quickly rendered."""
    return family


def sentence_of(operator, **properties) -> str:
    """Run an operator that must fail, and return the one sentence that it raises."""
    with pytest.raises(RuntimeError) as caught:
        operator(**properties)
    lines = str(caught.value).strip().splitlines()
    assert len(lines) == 1, lines
    return lines[0].removeprefix("Error: ")


def test_export_recipe_writes_the_whole_folder_beside_the_file(scene, tmp_path):
    assert bpy.ops.rtb.export_recipe() == {"FINISHED"}
    written = {path.name for path in (tmp_path / "rtb/cube").iterdir()}
    assert {"recipe.json", "parent.dae", "conditions.txt", "mappings.txt"} <= written


def test_export_recipe_writes_to_the_folder_it_is_given(scene, tmp_path):
    assert bpy.ops.rtb.export_recipe(folder=str(tmp_path / "elsewhere")) == {"FINISHED"}
    assert (tmp_path / "elsewhere/recipe.json").is_file()
    assert not (tmp_path / "rtb").exists()


def test_a_click_and_a_script_write_the_same_recipe(scene, module, tmp_path):
    bpy.ops.rtb.export_recipe(folder=str(tmp_path / "clicked"))
    module("rtb_addon.blender").read_recipe(scene).save(tmp_path / "scripted")
    for file in ("parent.dae", "conditions.txt", "mappings.txt"):
        assert (tmp_path / "clicked" / file).read_bytes() == (tmp_path / "scripted" / file).read_bytes()


def test_render_recipe_renders_every_condition_to_its_end_where_there_is_no_window(scene, tmp_path):
    assert bpy.ops.rtb.render_recipe() == {"FINISHED"}
    folder = tmp_path / "rtb/cube"
    assert sorted(path.stem for path in folder.glob("renderings/tracer/*.exr")) == ["blue", "green"]
    montage = bpy.data.images["cube"]
    assert Path(bpy.path.abspath(montage.filepath)) == folder / "images/tracer/cube.png"
    assert tuple(montage.size) == (2 * 24, 16)


def test_what_is_done_is_not_rendered_again(scene, tmp_path):
    bpy.ops.rtb.render_recipe()
    cubes = list((tmp_path / "rtb/cube/renderings/tracer").glob("*.exr"))
    before = [cube.stat().st_mtime_ns for cube in cubes]
    assert bpy.ops.rtb.render_recipe() == {"FINISHED"}
    assert [cube.stat().st_mtime_ns for cube in cubes] == before


def test_the_end_of_a_batch_says_how_much_was_done_before(scene, module, monkeypatch):
    told = []
    monkeypatch.setattr(module("operators.running"), "tell", lambda kind, sentence: told.append(sentence))
    bpy.ops.rtb.render_recipe()
    scene.rtb.conditions[1].cells[0].value = "0.9"
    bpy.ops.rtb.render_recipe()
    assert told == [
        "Recipe rendered, 2 of 2 conditions are done",
        "Recipe rendered, 2 of 2 conditions are done, 1 of them from before",
    ]


def test_show_montage_loads_the_picture_as_it_is_now(scene):
    bpy.ops.rtb.render_recipe()
    scene.rtb.width = 30
    bpy.ops.rtb.render_recipe()
    assert bpy.ops.rtb.show_montage() == {"FINISHED"}
    assert tuple(bpy.data.images["cube"].size) == (2 * 30, 16)
    assert [image.name for image in bpy.data.images if image.get("rtb_montage")] == ["cube"]


def test_show_montage_says_that_there_is_none_yet(scene):
    assert "press Render Recipe" in sentence_of(bpy.ops.rtb.show_montage)


def test_cancel_says_why_it_cannot(scene):
    assert not bpy.ops.rtb.cancel_rendering.poll()
    with pytest.raises(RuntimeError, match="No recipe is being rendered"):
        bpy.ops.rtb.cancel_rendering()


def test_one_batch_at_a_time(scene, module):
    running = module("operators.running")
    running.batch = object()
    try:
        assert bpy.ops.rtb.cancel_rendering.poll()
        with pytest.raises(RuntimeError, match="wait for it, or cancel it"):
            bpy.ops.rtb.render_recipe()
    finally:
        running.batch = None


def test_a_batch_that_is_stopped_keeps_what_is_done_and_leaves_no_process(scene, module, tmp_path):
    bpy.ops.rtb.render_recipe()
    scene.rtb.samples = 1_000_000
    bpy.ops.rtb.export_recipe()
    batch = module("operators.child_batch").ChildBatch(tmp_path / "rtb/cube")
    while not batch.total:
        batch.take()
    batch.stop()
    assert batch.ended
    assert batch.cancelled
    assert batch._child.poll() is not None
    assert len(list(tmp_path.glob("rtb/cube/renderings/tracer/*.exr"))) == 2
    assert not list(tmp_path.glob("rtb/cube/batch.lock"))


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (lambda scene: setattr(scene, "camera", None), "camera"),
        (lambda scene: bpy.data.objects.remove(bpy.data.objects["Light"]), "light"),
        (lambda scene: bpy.data.meshes["Cube"].materials.clear(), "material"),
        (lambda scene: setattr(bpy.data.materials["Material"].rtb, "reflectance", "blew"), "blew"),
        (lambda scene: setattr(bpy.data.materials["Material"].rtb, "reflectance", "gone.spd"), "gone.spd"),
        (lambda scene: setattr(bpy.data.materials["Material"].rtb, "reflectance", "(pant)"), "pant"),
    ],
)
@pytest.mark.parametrize("verb", ["export_recipe", "render_recipe"])
def test_a_wrong_scene_is_refused_in_one_sentence_in_report_and_panel(scene, module, verb, spoil, says):
    spoil(scene)
    sentence = sentence_of(getattr(bpy.ops.rtb, verb))
    assert says in sentence
    assert module("operators.findings").errors == [sentence]


def test_an_unsaved_file_has_no_place_for_a_relative_folder(extension):
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert "save" in sentence_of(bpy.ops.rtb.export_recipe)


def test_a_folder_that_cannot_be_written_is_named(scene, tmp_path):
    (tmp_path / "rtb").write_text("a file stands where the folder should be")
    sentence = sentence_of(bpy.ops.rtb.render_recipe)
    assert str(tmp_path / "rtb") in sentence
    assert (tmp_path / "rtb").is_file()


def test_a_folder_that_somebody_renders_in_is_left_alone(scene, module, tmp_path):
    bpy.ops.rtb.export_recipe()
    before = {path: path.read_bytes() for path in (tmp_path / "rtb/cube").iterdir() if path.is_file()}
    scene.rtb.samples = 7
    with module("rtb_addon.recipe.locks").locked(tmp_path / "rtb/cube"):
        sentence = sentence_of(bpy.ops.rtb.export_recipe)
    assert "has been rendering" in sentence
    assert all(path.read_bytes() == content for path, content in before.items())


def test_use_spectra_begins_with_the_materials_own_colour(scene):
    material = bpy.data.materials["Material"]
    material.rtb.use_spectra = False
    with bpy.context.temp_override(material=material):
        assert bpy.ops.rtb.use_spectra(thing="MATERIAL") == {"FINISHED"}
    assert material.rtb.use_spectra
    assert material.rtb.reflectance not in ("", "(paint)")
    assert bpy.ops.rtb.export_recipe() == {"FINISHED"}


def test_what_is_said_about_spectra_is_saved_with_the_file(scene, tmp_path):
    bpy.data.lights["Light"].rtb.spectrum = "daylight 5000"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "again.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert bpy.data.materials["Material"].rtb.reflectance != "(paint)"
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "again.blend"))
    settings = bpy.context.scene.rtb
    assert bpy.data.materials["Material"].rtb.reflectance == "(paint)"
    assert bpy.data.lights["Light"].rtb.spectrum == "daylight 5000"
    assert (settings.renderer, settings.samples, settings.width, settings.height) == ("tracer", 2, 24, 16)
    assert [condition.name for condition in settings.conditions] == list(PATCHES)


def test_undo_brings_back_what_was_said_before(scene):
    bpy.ops.ed.undo_push(message="Before")
    bpy.data.materials["Material"].rtb.reflectance = "0.25"
    bpy.ops.ed.undo_push(message="After")
    bpy.ops.ed.undo()
    assert bpy.data.materials["Material"].rtb.reflectance == "(paint)"
    bpy.ops.ed.redo()
    assert bpy.data.materials["Material"].rtb.reflectance == "0.25"


def test_blenders_own_process_stays_light(tmp_path):
    assert "heavy modules: none" in run_light_process(tmp_path, "home")


def run_light_process(folder: Path, home: str) -> str:
    """Return what a process of its own says that enables, exports and renders."""
    (folder / home).mkdir()
    usual = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    script = Path(__file__).with_name("light_process.py")
    finished = subprocess.run(
        [sys.executable, str(script), str(folder / home)],
        env={**usual, "PYTHONPYCACHEPREFIX": str(folder / "compiled")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def test_a_process_that_dies_leaves_its_last_words(scene, module, tmp_path, monkeypatch):
    child_batch = module("operators.child_batch")
    start = module("rtb_addon.background").start_child
    monkeypatch.setattr(child_batch, "start_child", lambda *_, **__: start([], module="rtb_addon.nowhere"))
    batch = child_batch.ChildBatch(tmp_path)
    batch.follow_to_the_end()
    assert batch.failures == [f"{sys.executable}: No module named rtb_addon.nowhere"]


def test_a_wrong_recipe_folder_is_one_sentence_from_the_child(scene, module, tmp_path):
    bpy.ops.rtb.export_recipe()
    (tmp_path / "rtb/cube/conditions.txt").write_text("imageName\tpaint\nblue\n")
    batch = module("operators.child_batch").ChildBatch(tmp_path / "rtb/cube")
    batch.follow_to_the_end()
    assert len(batch.failures) == 1
    assert batch.failures[0].startswith("conditions.txt:2: ")
