import hashlib
import os
import stat
import zipfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rtb_addon import archive_rules
from rtb_addon.__main__ import main
from rtb_addon.errors import RecipeError
from rtb_addon.recipe import Recipe
from rtb_addon.recipe.cleaning import clean_recipe
from rtb_addon.recipe.new import new_recipe
from rtb_addon.recipe.packing import CHECKSUMS, pack_recipe
from rtb_addon.recipe.unpacking import unpack_recipe


def tree(folder: Path) -> dict[str, bytes]:
    """Return the content of every file below a folder."""
    return {
        f.relative_to(folder).as_posix(): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file()
    }


@pytest.fixture
def family(write_family):
    """Write a family that names files of all kinds, and was rendered."""
    paints = {
        "a": "paint.spd",
        "b": "deep/other.spd",
        "c": "renderings/plain/seen.spd",
        "d": "mccBabel-1.spd",
    }
    spectrum = b"300 0.5\n800 0.5\n"
    recipe = write_family(paints, resources={"paint.spd": spectrum, "deep/other.spd": spectrum})
    for name in ("renderings/plain/a.exr", "renderings/plain/seen.spd", "scenes/plain/a.json", "notes.txt"):
        (recipe.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (recipe.folder / name).write_bytes(spectrum)
    (recipe.folder / "log.jsonl").write_text("{}\n")
    (recipe.folder / ".secret").write_text("of an editor")
    return Recipe.load(recipe.folder)


INPUTS = {
    "conditions.txt",
    "mappings.txt",
    "notes.txt",
    "parent.dae",
    "recipe.json",
    "renderings/plain/seen.spd",
    "resources/deep/other.spd",
    "resources/mccBabel-1.spd",
    "resources/paint.spd",
}


def test_packing_takes_along_every_file_that_the_recipe_names_and_no_rendering(family, tmp_path):
    assert pack_recipe(family, tmp_path / "f.zip") == []
    with zipfile.ZipFile(tmp_path / "f.zip") as archive:
        assert set(archive.namelist()) == INPUTS | {CHECKSUMS}


def test_renderings_come_along_where_they_are_asked_for_and_native_scenes_never(family, tmp_path):
    pack_recipe(family, tmp_path / "f.zip", renderings=True)
    unpack_recipe(tmp_path / "f.zip", tmp_path / "g")
    assert set(tree(tmp_path / "g")) == INPUTS | {"renderings/plain/a.exr", "log.jsonl"}


def test_a_recipe_survives_packing_and_unpacking_byte_for_byte(family, tmp_path):
    pack_recipe(family.folder, tmp_path / "f.zip")
    recipe = unpack_recipe(tmp_path / "f.zip", tmp_path / "new" / "g")
    assert recipe.folder == tmp_path / "new" / "g"
    inputs = {name: content for name, content in tree(family.folder).items() if name in INPUTS}
    assert tree(recipe.folder) == inputs
    assert recipe.problems() == []


def test_the_same_recipe_makes_the_same_archive_later_and_elsewhere(family, tmp_path):
    pack_recipe(family, tmp_path / "f.zip")
    recipe = unpack_recipe(tmp_path / "f.zip", tmp_path / "g")
    for file in recipe.folder.rglob("*"):
        os.utime(file, (2e9, 2e9))
    pack_recipe(recipe, recipe.folder / "g.zip")
    pack_recipe(recipe, recipe.folder / "g.zip")  # which does not pack itself
    assert (recipe.folder / "g.zip").read_bytes() == (tmp_path / "f.zip").read_bytes()


def test_the_checksums_are_those_that_other_tools_compute(family, tmp_path):
    pack_recipe(family, tmp_path / "f.zip")
    with zipfile.ZipFile(tmp_path / "f.zip") as archive:
        lines = archive.read(CHECKSUMS).decode().splitlines()
        for line in lines:
            digest, name = line.split("  ")
            assert hashlib.sha256(archive.read(name)).hexdigest() == digest
    assert len(lines) == len(INPUTS)


def test_what_is_missing_or_lies_outside_is_said_and_never_packed(write_family, tmp_path):
    (tmp_path / "secret.spd").write_text("300 1\n")
    recipe = write_family({"a": "gone.spd", "b": str(tmp_path / "secret.spd")})
    (recipe.folder / "link.txt").symlink_to(tmp_path / "secret.spd")
    sentences = pack_recipe(recipe, tmp_path / "f.zip")
    assert "gone.spd is not in the recipe's folder" in sentences
    assert "link.txt is no plain file of the folder and stays behind" in sentences
    assert any("lies outside the recipe's folder" in sentence for sentence in sentences)
    with zipfile.ZipFile(tmp_path / "f.zip") as archive:
        assert not [name for name in archive.namelist() if "secret" in name or "link" in name]


def test_a_file_that_deflates_like_a_bomb_is_stored_so_that_it_can_be_unpacked(write_family, tmp_path):
    recipe = write_family({"a": "0.5"}, resources={"dull.txt": b"0 " * 2_000_000})
    pack_recipe(recipe, tmp_path / "f.zip")
    unpacked = unpack_recipe(tmp_path / "f.zip", tmp_path / "g")
    assert (unpacked.folder / "resources" / "dull.txt").read_bytes() == b"0 " * 2_000_000


@pytest.fixture
def hostile(write_family, tmp_path):
    """Return a function that adds members to a good archive and returns how unpacking refuses it."""
    good = tmp_path / "good.zip"
    pack_recipe(write_family({"a": "0.5"}), good)

    def refused(*members, without_sums=True, **contents):
        file = tmp_path / "x.zip"
        with zipfile.ZipFile(good) as old, zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as new:
            for info in old.infolist():
                if not (without_sums and info.filename == CHECKSUMS) and info.filename not in contents:
                    new.writestr(info, old.read(info))
            for name, content in [*members, *contents.items()]:
                new.writestr(name, content)
        before = tree(tmp_path)
        with pytest.raises(RecipeError) as caught:
            unpack_recipe(file, tmp_path / "place" / "new")
        assert tree(tmp_path) == before
        assert not (tmp_path / "place").exists()
        assert "\n" not in str(caught.value)
        return str(caught.value)

    return refused


def special(name, mode):
    info = zipfile.ZipInfo(name)
    info.external_attr, info.create_system = mode << 16, 3
    return info


@pytest.mark.filterwarnings("ignore:Duplicate name:UserWarning")
@pytest.mark.parametrize(
    ("member", "sentence"),
    [
        ("/etc/evil", "is no relative name"),
        ("C:/evil", "is no relative name"),
        ("a\\evil", "is no relative name"),
        ("bell\x07", "is no relative name"),
        ("../evil", "leads out of the folder"),
        ("resources/../../evil", "leads out of the folder"),
        ("a/./b", "a name that some systems keep"),
        ("a//b", "a name that some systems keep"),
        ("resources/CON", "a name that some systems keep"),
        ("resources/com1.spd", "a name that some systems keep"),
        ("resources/nul.tar.gz", "a name that some systems keep"),
        ("resources/dot.", "a name that some systems keep"),
        ("resources/space ", "a name that some systems keep"),
        ("x" * 300, "is too long"),
        ("a/" * 40 + "b", "is too long"),
        ("recipe.json", "are one file on some systems"),
        ("Recipe.JSON", "are one file on some systems"),
        ("recipe.json/inside", "is a file and a folder at once"),
        (special("link", stat.S_IFLNK | 0o777), "is a link or a device"),
        (special("disk", stat.S_IFBLK | 0o666), "is a link or a device"),
        (special("pipe", stat.S_IFIFO | 0o666), "is a link or a device"),
        (special("plain/", stat.S_IFLNK | 0o777), "is a link or a device"),
    ],
)
def test_a_hostile_member_is_refused_in_one_sentence_and_nothing_is_written(hostile, member, sentence):
    assert sentence in hostile((member, b"/etc/passwd"))


def test_names_that_differ_in_how_an_accent_is_written_are_one_file(hostile):
    assert "are one file on some systems" in hostile(("caf\u00e9.spd", b""), ("cafe\u0301.spd", b""))


def test_bombs_by_ratio_count_and_overlap_are_refused(hostile, monkeypatch, tmp_path):
    assert "100 times its size" in hostile(("zeros", b"0" * 3_000_000))
    assert "100 times its size" in hostile(*((f"z{k}", b"0" * 60_000) for k in range(100)))
    monkeypatch.setattr(archive_rules, "MOST_FILES", 20)
    assert "20 at most" in hostile(*((f"f{k}", b"") for k in range(30)))
    monkeypatch.setattr(archive_rules, "MOST_BYTES", 1000)
    assert "bytes would unpack to" in hostile(("big", os.urandom(2000)))
    content = bytearray((tmp_path / "x.zip").read_bytes())
    with zipfile.ZipFile(tmp_path / "x.zip") as archive:
        offsets = [info.header_offset for info in archive.infolist()]
    at = content.rindex(b"PK\x01\x02")
    content[at + 42 : at + 46] = offsets[0].to_bytes(4, "little")
    (tmp_path / "x.zip").write_bytes(content)
    with pytest.raises(RecipeError, match="share bytes of the archive"):
        unpack_recipe(tmp_path / "x.zip", tmp_path / "y")


def test_entity_bombs_and_nested_json_are_refused(hostile):
    bomb = b'<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><COLLADA>&b;</COLLADA>'
    assert "may declare no document type and no entities" in hostile(**{"parent.dae": bomb})
    assert "may declare no document type" in hostile(("resources/deep/Other.DAE", bomb))
    assert "cannot be read" in hostile(**{"recipe.json": b"[" * 1_000_000})
    assert "cannot be read" in hostile(**{"recipe.json": b'{"format": ' + b"9" * 5000 + b"}"})


def test_what_differs_from_its_checksum_is_refused(hostile):
    changed = {"mappings.txt": b"% other words\n"}
    assert "is not what its checksum says" in hostile(without_sums=False, **changed)
    assert "stands only in it" in hostile(("more.txt", b""), without_sums=False)


def test_an_archive_of_something_else_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "x.zip", "w") as archive:
        archive.writestr("holiday.txt", "sun")
    (tmp_path / "y.zip").write_bytes(b"no zip at all")
    for name, sentence in (
        ("x.zip", "holds no recipe.json"),
        ("y.zip", "it is no zip, or it is damaged"),
        ("z.zip", "it cannot be unpacked: No such file"),
    ):
        with pytest.raises(RecipeError, match=sentence):
            unpack_recipe(tmp_path / name, tmp_path / "new")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["x.zip", "y.zip"]


@pytest.mark.parametrize("root", ["family/", ""])
def test_a_zip_that_another_tool_made_of_a_folder_is_unpacked_without_what_a_batch_left(
    family, tmp_path, root
):
    (family.folder / "batch.lock").write_text("{}")
    with zipfile.ZipFile(tmp_path / "x.zip", "w") as archive:
        for name, content in tree(family.folder).items():
            archive.writestr(root + name, content)
    unpacked = unpack_recipe(tmp_path / "x.zip", tmp_path / "new")
    served = {"resources/mccBabel-1.spd"}  # which is written when somebody first asks
    assert set(tree(unpacked.folder)) == INPUTS - served | {"renderings/plain/a.exr", "log.jsonl"}


def test_a_folder_that_is_there_is_never_unpacked_into(family, tmp_path):
    pack_recipe(family, tmp_path / "f.zip")
    (tmp_path / "link").symlink_to(tmp_path / "nowhere")
    for place in (family.folder, tmp_path / "f.zip", tmp_path / "link"):
        with pytest.raises(RecipeError, match="is there already, name a new folder"):
            unpack_recipe(tmp_path / "f.zip", place)
    (tmp_path / "empty").mkdir()
    assert unpack_recipe(tmp_path / "f.zip", tmp_path / "empty").name == "family"


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(at=st.integers(0, 10_000), byte=st.integers(0, 255))
def test_whatever_byte_is_damaged_the_recipe_comes_out_as_it_was_or_not_at_all(tmp_path_factory, at, byte):
    folder = tmp_path_factory.mktemp("damaged")
    recipe = new_recipe(folder / "f", b"<COLLADA/>", mappings="% nothing\n")
    with zipfile.ZipFile(folder / "f.zip", "w") as archive:
        for name, content in tree(recipe.folder).items():
            archive.writestr(name, content)
        sums = "".join(f"{hashlib.sha256(c).hexdigest()}  {n}\n" for n, c in tree(recipe.folder).items())
        archive.writestr(CHECKSUMS, sums)
    content = bytearray((folder / "f.zip").read_bytes())
    content[at % len(content)] = byte
    (folder / "f.zip").write_bytes(content)
    try:
        unpacked = unpack_recipe(folder / "f.zip", folder / "g")
    except RecipeError:
        assert sorted(path.name for path in folder.iterdir()) == ["f", "f.zip"]
    else:
        assert tree(unpacked.folder) == tree(recipe.folder) or CHECKSUMS.encode() not in content


def test_cleaning_removes_what_can_be_rendered_again_and_no_input(family):
    before = tree(family.folder)
    gone = clean_recipe(family)
    assert {path.relative_to(family.folder).as_posix() for path in gone} == {
        "renderings/plain/a.exr",
        "scenes/plain/a.json",
    }
    after = tree(family.folder)
    assert set(after) == INPUTS | {"log.jsonl", ".secret"}
    assert all(before.get(name, content) == content for name, content in after.items())
    assert not (family.folder / "scenes").exists()


def test_cleaning_follows_a_link_that_is_the_folder_of_renderings_but_none_below_it(write_family, tmp_path):
    recipe = write_family({"a": "0.5"})
    disk, other = tmp_path / "disk", tmp_path / "other"
    for folder in (disk, other):
        folder.mkdir()
        (folder / "a.exr").write_bytes(b"a cube")
    (recipe.folder / "renderings").symlink_to(disk)
    (disk / "plain").symlink_to(other)
    clean_recipe(recipe)
    assert list(disk.iterdir()) == [disk / "plain"]
    assert (other / "a.exr").is_file()


def test_a_new_recipe_is_checked_when_it_is_made(write_family, tmp_path):
    parent = write_family({"a": "0.5"}).folder / "parent.dae"
    recipe = new_recipe(tmp_path / "new", parent, renderer="plain", width=4, height=3)
    assert (recipe.name, recipe.options.width, [c.name for c in recipe.conditions]) == ("new", 4, ["new"])
    for words, sentence in (
        ({"width": 0}, "width is 0"),
        ({"colour": 3}, "colour"),
        ({"conditions": "imageName\tx\na\n"}, "conditions.txt:2"),
        ({"parent": b"<html/>"}, "want Collada"),
        ({"parent": "nowhere.dae"}, "cannot read the parent scene"),
    ):
        with pytest.raises(RecipeError, match=sentence):
            new_recipe(**{"folder": tmp_path / "other", "parent": parent, **words})
    with pytest.raises(RecipeError, match="holds a recipe already"):
        new_recipe(tmp_path / "new", parent)
    assert not (tmp_path / "other").exists()


def test_the_command_line_packs_and_unpacks(family, tmp_path, capsys):
    file, folder = str(tmp_path / "f.zip"), str(tmp_path / "g")
    assert main(["pack", str(family.folder), file]) == 0
    assert main(["unpack", file, folder]) == 0
    assert capsys.readouterr().out.splitlines() == [file, folder]
    assert main(["unpack", file, folder]) == 2
    assert capsys.readouterr().err.strip() == f"{folder} is there already, name a new folder"
