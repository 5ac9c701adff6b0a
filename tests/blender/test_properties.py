"""What a .blend file keeps of RenderToolbox."""

import subprocess
import sys
import textwrap

import bpy
import pytest

ROWS = [("dusk", "daylight 4000", "0.2"), ("noon", "daylight 6500", "0.3")]


@pytest.fixture
def tagged(scene, box, lamp, library):
    """A scene whose every kind of property says something that is no default."""
    shining, placed = box(), lamp()
    world = scene.world = bpy.data.worlds.new("World")
    settings = scene.rtb
    settings.name, settings.folder, settings.renderer = "family", "//here/NAME/", "tracer"
    settings.samples, settings.seed, settings.integrator, settings.depth = 5, 7, "direct", 3
    settings.bands_start, settings.bands_step, settings.bands_count = 420, 20, 12
    settings.montage_columns, settings.montage_fill = 4, "rows"
    material = bpy.data.materials["Paint"].rtb
    material.use_spectra, material.reflectance = True, "(paint)"
    placed.data.rtb.use_spectra, placed.data.rtb.spectrum = True, "(light)"
    world.rtb.use_spectra, world.rtb.spectrum, world.rtb.amount = True, "A", 2.5
    body = shining.rtb
    body.emits, body.spectrum, body.emission, body.amount = True, "FL2", "watts", 12
    scene.rtb.set_conditions(["imageName", "light", "paint"], ROWS)
    return scene


def kept(scene) -> dict:
    """Return everything that the scene says."""
    groups = {
        "scene": scene.rtb,
        "material": bpy.data.materials["Paint"].rtb,
        "light": bpy.data.lights["Lamp"].rtb,
        "world": bpy.data.worlds["World"].rtb,
        "object": bpy.data.objects["Box"].rtb,
    }
    found = {
        f"{name}.{key}": getattr(group, key)
        for name, group in groups.items()
        for key, kind in group.bl_rna.properties.items()
        if kind.type not in ("COLLECTION", "POINTER")
    }
    found["variables"] = [each.name for each in scene.rtb.variables]
    found["rows"] = [(row.name, *(cell.value for cell in row.cells)) for row in scene.rtb.conditions]
    return found


def test_nothing_is_forgotten_by_saving_and_opening(tagged, library, tmp_path):
    before = kept(tagged)
    assert before["rows"] == [tuple(row) for row in ROWS]
    assert before["scene.schema"] == library("blender.migration").SCHEMA
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "family.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "family.blend"))
    assert kept(bpy.context.scene) == before


def test_materials_and_lamps_bring_their_spectra_into_another_file(tagged, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "family.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(str(tmp_path / "family.blend")) as (_, wanted):
        wanted.materials, wanted.lights, wanted.objects = ["Paint"], ["Lamp"], ["Box"]
    assert bpy.data.materials["Paint"].rtb.reflectance == "(paint)"
    assert bpy.data.lights["Lamp"].rtb.use_spectra
    assert bpy.data.objects["Box"].rtb.emission == "watts"


def test_undo_takes_a_spectrum_and_a_row_back(tagged):
    before = kept(tagged)
    bpy.ops.ed.undo_push(message="before")
    bpy.data.materials["Paint"].rtb.reflectance = "0.9"
    tagged.rtb.conditions.add().name = "third"
    bpy.ops.ed.undo_push(message="after")
    assert kept(bpy.context.scene) != before
    bpy.ops.ed.undo()
    assert kept(bpy.context.scene) == before
    bpy.ops.ed.redo()
    assert bpy.data.materials["Paint"].rtb.reflectance == "0.9"


def other(kind, value):
    """Return a value that a property may have and has not."""
    if kind.type == "ENUM" and kind.is_enum_flag:
        return {each.identifier for each in kind.enum_items} - value
    if kind.type == "ENUM":
        known = [each.identifier for each in kind.enum_items] or ["mitsuba", "tracer"]  # ours are asked for
        return next(each for each in known if each != value)
    return {"STRING": f"{value}x", "BOOLEAN": not value}.get(kind.type) or value + 1


def test_undo_and_redo_reach_everything_that_a_scene_says(tagged):
    before = kept(tagged)
    bpy.ops.ed.undo_push(message="before")
    settings = tagged.rtb
    for name, kind in settings.bl_rna.properties.items():
        if kind.type not in ("COLLECTION", "POINTER") and not kind.is_readonly:
            setattr(settings, name, other(kind, getattr(settings, name)))
    settings.mappings_text = bpy.data.texts.new("Further")
    settings.mappings.add().path = "location"
    settings.variables.add().name = "gloss"
    after = kept(tagged)
    assert not [name for name in before if name.startswith("scene.") and before[name] == after[name]]
    bpy.ops.ed.undo_push(message="after")
    for step, said, counts in (
        (bpy.ops.ed.undo, before, (0, None)),
        (bpy.ops.ed.redo, after, (1, "Further")),
    ):
        step()
        settings = bpy.context.scene.rtb
        text = settings.mappings_text and settings.mappings_text.name
        assert kept(bpy.context.scene) == said
        assert (len(settings.mappings), text) == counts


def test_the_size_is_that_of_blenders_renders(scene):
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1001, 500, 50
    assert (scene.rtb.width, scene.rtb.height) == (500, 250)
    scene.rtb.width = 320
    assert (scene.rtb.width, scene.rtb.height) == (320, 250)
    assert (scene.render.resolution_x, scene.render.resolution_percentage) == (320, 100)


def test_a_table_with_a_cell_too_few_is_refused_before_anything_changes(tagged, library):
    with pytest.raises(ValueError, match="row 2 has 1 cells for 2 variables"):
        library("blender").set_conditions(tagged, ["a", "b"], [("1", "2"), ("3",)])
    assert [each.name for each in tagged.rtb.variables] == ["light", "paint"]


def test_registering_twice_and_unregistering_twice_is_harmless_and_the_process_ends(tmp_path):
    script = """
        import bpy
        from rtb_addon.blender import register, set_conditions, unregister
        register(); register()
        set_conditions(bpy.context.scene, ["a"], [["1"]])
        unregister(); unregister()
        assert not hasattr(bpy.types.Scene, "rtb")
        register()
        assert bpy.context.scene.rtb.conditions[0].cells[0].value == "1"
        print("ended")
    """
    finished = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (finished.returncode, finished.stdout.split()[-1]) == (0, "ended"), finished.stderr[-500:]
