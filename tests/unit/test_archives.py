"""Parent scenes in a .zae: read, or refused in a sentence."""

import io
import stat
import zipfile

import pytest

from rtb_addon import archive_rules
from rtb_addon.errors import RecipeError
from rtb_addon.recipe.named_files import texture_names
from rtb_addon.recipe.new import new_recipe
from rtb_addon.recipe.packing import pack_recipe
from rtb_addon.scene import archives
from rtb_addon.scene.archives import read_archive
from rtb_addon.scene.build import SceneBuilder
from rtb_addon.scene.document import Scene

MANIFEST = '<?xml version="1.0"?><dae_root>./scene/my%20room.dae</dae_root>'


def room():
    builder = SceneBuilder()
    builder.plane("Wall")
    return builder.tobytes()


def packed(files, change=None):
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name)
            entry.compress_type = zipfile.ZIP_DEFLATED
            if change and name in change:
                entry.external_attr = change[name]
            archive.writestr(entry, content)
    return written.getvalue()


FILES = {"manifest.xml": MANIFEST, "scene/my room.dae": room(), "scene/images/wood.png": b"wood"}


def test_the_scene_that_the_manifest_names_is_read(tmp_path):
    found = read_archive(packed({**FILES, "other.dae": b"x"}), "room.zae")
    assert found.name == "scene/my room.dae"
    assert found.others["scene/images/wood.png"] == b"wood"
    (tmp_path / "room.zae").write_bytes(packed(FILES))
    assert "Wall-mesh" in Scene.read(tmp_path / "room.zae").ids


def test_the_only_scene_needs_no_manifest():
    assert read_archive(packed({"a/room.dae": room()}), "room.zae").scene == room()


@pytest.mark.parametrize(
    ("files", "words"),
    [
        ({**FILES, "../evil.txt": b""}, "leads out of the folder"),
        ({**FILES, "/etc/evil.txt": b""}, "is no relative name"),
        ({**FILES, "C:/evil.txt": b""}, "is no relative name"),
        ({**FILES, "a\\..\\evil.txt": b""}, "is no relative name"),
        ({"a.dae": room(), "b.dae": room()}, "it holds 2 scenes and no manifest.xml"),
        ({}, "it holds 0 scenes"),
        (
            {"manifest.xml": "<dae_root>gone.dae</dae_root>"},
            "names the scene 'gone.dae', which it does not hold",
        ),
        ({"manifest.xml": "<dae_root>"}, "its manifest.xml is no XML"),
        ({"manifest.xml": '<!DOCTYPE a [<!ENTITY b "c">]><dae_root>&b;</dae_root>'}, "no document type"),
    ],
)
def test_an_archive_with_surprises_is_refused(files, words):
    with pytest.raises(RecipeError, match=f"room.zae: .*{words}"):
        read_archive(packed(files), "room.zae")


def test_links_are_refused():
    link = {"scene/images/wood.png": (stat.S_IFLNK | 0o777) << 16}
    with pytest.raises(RecipeError, match=r"'scene/images/wood.png' is a link"):
        read_archive(packed(FILES, link), "room.zae")


def test_what_unpacks_to_more_than_it_may_is_refused_before_it_is_unpacked(monkeypatch):
    data = packed({**FILES, "bomb": bytes(2**21)})
    assert len(data) < 10_000
    with pytest.raises(RecipeError, match=r"would unpack to 2.*, 100 times its size and 2 GiB are the most"):
        read_archive(data, "room.zae")
    lying = data.replace((2**21).to_bytes(4, "little"), (10).to_bytes(4, "little"))
    with pytest.raises(RecipeError, match=r"^room\.zae: "):
        read_archive(lying, "room.zae")
    monkeypatch.setattr(archives, "MOST_BYTES", 1000)
    with pytest.raises(RecipeError, match="would unpack to"):
        read_archive(packed(FILES), "room.zae")


def test_too_many_files_are_refused(monkeypatch):
    monkeypatch.setattr(archive_rules, "MOST_FILES", 2)
    with pytest.raises(RecipeError, match="it holds 3 files, 2 at most"):
        read_archive(packed(FILES), "room.zae")


def test_two_files_of_one_name_are_refused():
    written = io.BytesIO(packed(FILES))
    with zipfile.ZipFile(written, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
        archive.writestr("manifest.xml", MANIFEST)
    with pytest.raises(RecipeError, match=r"are one file on some systems"):
        read_archive(written.getvalue(), "room.zae")


@pytest.mark.parametrize("size", [4, 30, 200])
def test_a_broken_archive_is_refused_in_a_sentence(size):
    with pytest.raises(RecipeError, match="no readable zip"):
        read_archive(packed(FILES)[:size], "room.zae")


def pictured():
    """Return a scene in an archive, whose material has a picture in it."""
    image = "<library_images><image id='wood'><init_from>images/wood.png</init_from></image></library_images>"
    scene = room().replace(b"<library_geometries>", image.encode() + b"<library_geometries>")
    assert scene != room()
    return packed({**FILES, "scene/my room.dae": scene})


def test_a_new_recipe_holds_the_scene_and_the_pictures_of_an_archive(tmp_path):
    (tmp_path / "room.zae").write_bytes(pictured())
    recipe = new_recipe(tmp_path / "new", tmp_path / "room.zae")
    assert (recipe.folder / "parent.dae").read_bytes().startswith(b"<?xml")
    assert (recipe.folder / "resources" / "images" / "wood.png").read_bytes() == b"wood"
    assert recipe.find_file("images/wood.png") == recipe.folder / "resources" / "images" / "wood.png"


def test_pictures_in_a_conditions_archive_are_found_told_and_packed(tmp_path):
    recipe = new_recipe(
        tmp_path / "new",
        room(),
        conditions="imageName\tcolladaFile\na\troom.zae\n",
        resources={"room.zae": pictured()},
    )
    assert texture_names(recipe.parent_file(recipe.conditions["a"])) == ["images/wood.png"]
    pack_recipe(recipe, tmp_path / "new.zip")
    assert "resources/wood.png" in zipfile.ZipFile(tmp_path / "new.zip").namelist()
    assert recipe.find_file("images/wood.png").read_bytes() == b"wood"
    assert recipe.resources.warnings == ["files of a .zae went into resources/: wood.png of room.zae"]
