"""Spectra in files, typed: found again where things, or the whole .blend, come to another folder."""

from pathlib import Path

import bpy
import pytest

PAINT, LAMP, CHECK = b"400 0.2\n700 0.6\n", b"400 1\n700 2\n", b"400 0.9\n700 0.9\n"


@pytest.fixture
def studio(extension, tmp_path) -> Path:
    """A .blend with a painted cube and a lamp, whose spectra lie beside it."""
    folder = tmp_path / "studio"
    folder.mkdir()
    for name, content in (("paint.spd", PAINT), ("lamp.spd", LAMP), ("check.spd", CHECK)):
        (folder / name).write_bytes(content)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "studio.blend"))
    inside = bpy.data.materials.new("Inside")
    inside.rtb.use_spectra, inside.rtb.reflectance = True, "//paint.spd"
    paint = bpy.data.materials["Material"].rtb
    paint.use_spectra, paint.model, paint.part, paint.other_part = True, "blend", inside, inside
    texture = inside.rtb.reflectance_texture
    texture.kind, texture.even, texture.odd = "checkerboard", "//paint.spd", "//check.spd"
    light = bpy.data.lights["Light"].rtb
    light.use_spectra, light.spectrum, light.measure, light.amount = True, "//lamp.spd", "LUX", 300
    bpy.ops.wm.save_mainfile()
    return folder / "studio.blend"


@pytest.fixture
def bring(studio, tmp_path):
    """Return how to bring objects of the studio into a new file in another folder."""

    def into_another_file(verb, *names: str) -> None:
        bpy.ops.wm.read_homefile(use_factory_startup=True)
        for each in (bpy.data.objects["Cube"], bpy.data.objects["Light"]):
            bpy.data.objects.remove(each)
        bpy.data.orphans_purge(do_recursive=True)
        (tmp_path / "paper").mkdir()
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "paper/paper.blend"))
        take(verb, studio, *names)

    return into_another_file


def take(verb, file: Path, *names: str) -> None:
    objects = f"{file}/Object/"
    for name in names:
        assert verb(filepath=objects + name, directory=objects, filename=name) == {"FINISHED"}


@pytest.mark.parametrize("verb", [bpy.ops.wm.append, bpy.ops.wm.link], ids=["append", "link"])
def test_a_painted_cube_and_its_lamp_bring_their_spectra_along(studio, bring, library, verb):
    there = library("blender").read_recipe(bpy.context.scene).resources
    assert PAINT in there.values()
    bring(verb, "Cube", "Light")
    here = library("blender").read_recipe(bpy.context.scene).resources
    assert sorted(here.values()) == sorted(there.values())


def test_what_is_appended_names_its_files_from_here(bring):
    bring(bpy.ops.wm.append, "Cube", "Light")
    inside, light = bpy.data.materials["Inside"].rtb, bpy.data.lights["Light"].rtb
    assert inside.reflectance == "//../studio/paint.spd"
    assert inside.reflectance_texture.odd == "//../studio/check.spd"
    assert (light.spectrum, light.measure, light.amount) == ("//../studio/lamp.spd", "LUX", 300)
    assert inside.reflectance_texture.kind == "checkerboard"


def test_in_a_file_that_was_never_saved_whole_paths_are_named(studio):
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    take(bpy.ops.wm.append, studio, "Light")
    assert bpy.data.lights["Light.001"].rtb.spectrum == str(studio.with_name("lamp.spd"))


def test_what_is_linked_stays_as_it_is_in_its_own_file(bring):
    bring(bpy.ops.wm.link, "Light")
    (light,) = bpy.data.lights
    assert light.library is not None
    assert light.rtb.spectrum == "//lamp.spd"


@pytest.mark.parametrize("text", ["BabelColor Average/blue", "(paint)", "400:0.2 700:0.8", "0.5", "/a/b.spd"])
def test_what_is_no_relative_path_stays(text, library, tmp_path):
    assert library("blender.typed_paths").moved(text, tmp_path, tmp_path / "other") == text


def test_a_file_saved_in_another_folder_still_renders_the_same(studio, library, tmp_path):
    read_recipe = library("blender").read_recipe
    before = read_recipe(bpy.context.scene).resources
    (tmp_path / "copy/of").mkdir(parents=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy/of/studio.blend"))
    assert bpy.data.lights["Light"].rtb.spectrum == "//../../studio/lamp.spd"
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "copy/of/studio.blend"))
    assert read_recipe(bpy.context.scene).resources == before


def test_a_copy_names_its_files_from_where_it_is_and_the_open_file_stays(studio, tmp_path):
    (tmp_path / "copy").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy/copy.blend"), copy=True)
    assert bpy.data.lights["Light"].rtb.spectrum == "//lamp.spd"
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "copy/copy.blend"))
    assert bpy.data.lights["Light"].rtb.spectrum == "//../studio/lamp.spd"


def test_files_that_somebody_has_copied_along_are_those_that_count(studio, tmp_path):
    (tmp_path / "copy").mkdir()
    (tmp_path / "copy/lamp.spd").write_bytes(LAMP)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy/studio.blend"))
    assert bpy.data.lights["Light"].rtb.spectrum == "//lamp.spd"
    assert bpy.data.materials["Inside"].rtb.reflectance == "//../studio/paint.spd"
