import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import pytest

from rtb_addon.__main__ import main
from rtb_addon.recipe import Recipe

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def run(capfd, plugin):
    """Return a function that runs a command and returns its exit status, output and words of error."""

    def command(*words):
        before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            status = main([str(word) for word in words])
        except SystemExit as end:  # argparse's own
            status = end.code
        finally:
            for number, action in before.items():
                signal.signal(number, action)
        output, error = capfd.readouterr()
        assert "Traceback" not in error
        return status, output, error

    return command


def started(recipe, *words):
    command = [sys.executable, "-m", "rtb_addon", "render", str(recipe.folder), *words]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_render_shows_progress_and_says_where_things_are(write_family, run):
    recipe = write_family({"a": "0.2", "b": "0.8"})
    status, output, error = run("render", recipe.folder, "--jobs", 1)
    assert status == 0
    assert "2 rendered, 0 found done, 0 failed" in output
    assert str(recipe.folder / "renderings" / "plain") in output
    montage = recipe.folder / "images" / "plain" / "family.png"
    assert f"montage: {montage}" in output
    assert montage.read_bytes().startswith(b"\x89PNG")
    assert "2 conditions" in error
    assert run("render", recipe.folder)[1].startswith("0 rendered, 2 found done, 0 failed")


def test_a_renderer_whose_package_does_not_load_is_missing_and_says_why(tmp_path, monkeypatch, run):
    (tmp_path / "broken-1.0.dist-info").mkdir()
    entry = "[rtb_addon.renderers]\nbroken = nowhere_at_all:Renderer\n"
    (tmp_path / "broken-1.0.dist-info/entry_points.txt").write_text(entry)
    monkeypatch.syspath_prepend(str(tmp_path))
    status, output, _ = run("renderers")
    said = {line.split()[0]: line for line in output.splitlines()}
    assert status == 0
    assert "missing: ModuleNotFoundError: No module named 'nowhere_at_all'" in said["broken"]
    assert "missing" not in said["plain"]


def test_a_condition_whose_name_has_a_comma_in_it_is_named_in_quotes(write_family, run):
    recipe = write_family({"dark, wet": "0.2", "dark": "0.3", "wet": "0.4", "-5": "0.8"})
    said = run("render", recipe.folder, "--jobs", 1, "--conditions", '"dark, wet",wet')[1]
    assert said.startswith("2 rendered")
    assert "1 rendered" in run("render", recipe.folder, "--jobs", 1, "--conditions=-5")[1]
    done = {file.stem for file in recipe.folder.glob("renderings/plain/*.exr")}
    assert done == {"dark, wet", "wet", "-5"}


def test_render_tells_events_as_lines_of_json(write_family, run):
    recipe = write_family({"a": "0.2", "b": "0.8"})
    status, output, error = run("render", recipe.folder, "--json", "--jobs", 1, "--conditions", "b")
    events = [json.loads(line) for line in output.splitlines()]
    assert (status, error) == (0, "")
    assert (events[0]["kind"], events[-1]["kind"]) == ("started", "finished")
    assert events[-1]["file"] == str(recipe.folder / "images" / "plain" / "family.png")
    assert [event["condition"] for event in events if event["kind"] == "done"] == ["b"]


def test_some_conditions_that_fail_give_status_one_and_a_sentence(write_family, run):
    recipe = write_family({"fails": "0.2", "good": "0.8"})
    status, output, error = run("render", recipe.folder, "--jobs", 1)
    assert status == 1
    assert "the lamp is broken (fails)" in error
    assert "1 rendered, 0 found done, 1 failed" in output
    assert recipe.rendering_file(recipe.conditions["good"]).is_file()


def test_a_wrong_recipe_gives_status_two_with_file_and_line(write_family, run):
    recipe = write_family({"a": "0.2"})
    (recipe.folder / "conditions.txt").write_text("imageName\tpaint\na\n")
    for verb in ("render", "check"):
        status, _, error = run(verb, recipe.folder)
        assert status == 2
        assert error.strip() == "conditions.txt:2: 1 value for 2 variables (imageName, paint)"


def test_a_missing_file_in_every_condition_is_a_wrong_recipe(write_family, run):
    recipe = write_family({"a": "nowhere.spd", "b": "nowhere.spd"})
    status, _, error = run("render", recipe.folder, "--jobs", 1)
    assert status == 2
    assert "nowhere.spd" in error
    assert "(a, b)" in error


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["render", "nowhere"], "nowhere is no recipe folder: it holds no recipe.json"),
        (["render", "FOLDER", "--renderer", "povray"], "no renderer is called povray, choose one of mitsuba"),
        (["render", "FOLDER", "--conditions", "x"], "no condition is called x, there are a"),
        (["render", "FOLDER", "--size", "12"], "12 is no size like 320x240"),
        (["render", "FOLDER", "--samples", "0"], "0 is no whole number from 1"),
        (["render", "FOLDER", "--scheduler", "gopher://x"], "no Dask scheduler answers at gopher://x"),
        (["montage", "FOLDER"], "holds no renderings yet, render it first"),
        (["import", "nowhere.dae", "--output", "x"], "cannot read nowhere.dae: No such file or directory"),
        (["import", "nowhere.dae", "--output", "x", "--convention", "cgs"], "invalid choice: 'cgs'"),
        (["sing"], "invalid choice: 'sing'"),
    ],
)
def test_a_wrong_word_is_one_sentence(write_family, run, tmp_path, monkeypatch, words, sentence):
    folder = write_family({"a": "0.2"}).folder
    monkeypatch.chdir(tmp_path)
    status, _, error = run(*(str(folder) if word == "FOLDER" else word for word in words))
    assert status == (1 if words[0] == "montage" else 2)
    assert sentence in error


def test_check_says_every_problem_and_what_the_numbers_mean(write_family, run):
    recipe = write_family({"a": "nowhere.spd", "b": "0.2"})
    (recipe.folder / "conditions.txt").write_text(
        "imageName\tpaint\trenderer\na\tnowhere.spd\tplain\nb\t0.2\tpovray\n"
    )
    status, output, error = run("check", recipe.folder)
    assert status == 2
    assert len(error.splitlines()) == 2
    assert "family: units si: a point light's numbers are W sr-1 nm-1" in output
    status, output, _ = run("check", recipe.folder, "--json")
    said = [json.loads(line) for line in output.splitlines()]
    assert [each["problem"] for each in said].count(True) == 2
    assert said[-1]["meaning"] == {"units": "si", "handedness": "blender", "band_kind": "averaged"}
    assert "units si: a point light's numbers are W sr-1 nm-1" in said[-1]["sentence"]
    assert said[-1]["done"] == []
    assert run("check", write_family({"a": "0.2"}, folder="good").folder)[0] == 0


def test_renderers_are_listed_with_their_versions_and_reasons(run, plugin):
    plugin.setenv("PLAIN_MISSING", "its disk is in the cellar")
    status, output, _ = run("renderers")
    assert status == 0
    assert "plain      missing: its disk is in the cellar" in output
    lines = [json.loads(line) for line in run("renderers", "--json")[1].splitlines()]
    assert {line["renderer"] for line in lines} >= {"mitsuba", "tracer", "plain"}


def test_montage_goes_where_it_is_told(write_family, run, tmp_path):
    recipe = write_family({"a": "0.2", "b": "0.8"})
    run("render", recipe.folder, "--jobs", 1)
    status, output, _ = run("montage", recipe.folder, "--output", tmp_path / "picture.png")
    assert (status, output.strip()) == (0, str(tmp_path / "picture.png"))
    assert (tmp_path / "picture.png").is_file()


def test_a_batch_makes_a_montage_anew_only_where_something_changed(write_family, run):
    recipe = write_family({"a": "0.2", "b": "0.8"})
    picture = recipe.montage_file("plain")

    def made():
        assert run("render", recipe.folder, "--jobs", 1)[1].endswith(f"montage: {picture}\n")
        return picture.stat().st_mtime_ns

    first = made()
    assert made() == first
    recipe.rendering_file(recipe.conditions["a"]).unlink()
    second = made()
    assert second > first
    file = recipe.folder / "recipe.json"
    file.write_text(file.read_text().replace('"columns": null', '"columns": 1'))
    assert made() > second


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_batch_ends_with_130_and_keeps_what_is_done(write_family, plugin, number):
    plugin.setenv("PLAIN_PASS", "0.02")
    recipe = write_family({"a": "0.2", "b": "0.4", "c": "0.8"}, samples=20)
    process = started(recipe, "--jobs", "1", "--json")
    for line in process.stdout:
        if json.loads(line)["kind"] == "done":
            break
    process.send_signal(number)
    began = time.monotonic()
    output, error = process.communicate(timeout=10)
    assert time.monotonic() - began < 1
    assert (process.returncode, error) == (130, "")
    assert json.loads(output.splitlines()[-1])["kind"] == "cancelled"
    assert recipe.rendering_file(recipe.conditions["a"]).is_file()
    assert not (recipe.folder / "batch.lock").exists()


def test_a_folder_that_may_only_be_read_is_one_sentence(write_family):
    # The superuser may write anywhere, so he becomes nobody once he has read all of the program.
    code = (
        "import encodings.utf_8_sig, os, sys; from rtb_addon.__main__ import main;"
        "import rtb_addon.command_line;"
        "os.geteuid() or (os.setgid(65534), os.setuid(65534)); sys.exit(main(sys.argv[1:]))"
    )
    # pytest's own folders are closed to anybody else.
    with tempfile.TemporaryDirectory() as place:
        folder = Path(shutil.copytree(write_family({"a": "0.2"}).folder, Path(place) / "family"))
        Path(place).chmod(0o755)
        folder.chmod(0o555)
        command = [sys.executable, "-c", code, "render", str(folder), "--json"]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        folder.chmod(0o755)
    assert done.returncode == 2
    assert done.stderr.strip() == (
        f"cannot write into {folder} (Permission denied); make it writable, or render a copy of it"
    )


def test_import_makes_a_folder_that_holds_all_it_needs(tmp_path, run, old_recipe):
    parent, conditions, mappings = old_recipe
    status, output, error = run(
        "import", parent, conditions, mappings, "--output", tmp_path / "new", "--data", tmp_path / "data"
    )
    assert (status, output.strip()) == (0, f"old: 3 conditions in {tmp_path / 'new'}")
    found = {f.relative_to(tmp_path / "new" / "resources") for f in (tmp_path / "new/resources").rglob("*.*")}
    assert {str(file) for file in found} == {"beside.spd", "inside.spd", "far.spd", "stone.png"}
    assert error.splitlines() == [
        "not found, the library's own will be served: D65.spd",
        "gone.spd was not found, name its folder with --data or put it into resources/",
    ]
    recipe = Recipe.load(tmp_path / "new")
    assert (recipe.conventions.units, recipe.conventions.handedness) == ("si", "rtb3")
    options = recipe.options
    assert (options.integrator, options.depth, options.width, options.height) == ("direct", 2, 320, 240)
    assert (recipe.folder / "parent.dae").read_bytes() == parent.read_bytes()
    assert (recipe.folder / "conditions.txt").read_text() == conditions.read_text()
    assert (recipe.folder / "mappings.txt").read_text() == mappings.read_text()
    for name in ("beside.spd", "resources/inside.spd", "far.spd", "file:///C:/me/stone.png"):
        assert recipe.find_file(name) is not None


def test_import_without_tables_makes_one_condition_with_the_camera_mirrored_back(tmp_path, run, old_recipe):
    status, _, _ = run("import", old_recipe[0], "--output", tmp_path / "new", "--convention", "rtb3")
    recipe = Recipe.load(tmp_path / "new")
    assert (status, recipe.conventions.units) == (0, "rtb3")
    assert [condition.name for condition in recipe.conditions] == ["old"]
    assert "Camera:scale|sid=scale = -1 1 1" in (recipe.folder / "mappings.txt").read_text()
    assert recipe.problems() == []


def test_import_takes_rendertoolbox4s_json_and_leaves_out_rows_of_another_length(tmp_path, run, old_recipe):
    changes = [
        {"name": "Lamp", "broadType": "lights", "specificType": "point", "operation": "update"},
        {"name": "Lamp", "broadType": "nodes", "operation": "delete", "destination": "mexximp", "group": "x"},
    ]
    (tmp_path / "old.json").write_text(json.dumps(changes))
    (tmp_path / "rows.txt").write_text("imageName\tgroupName\na\ty\nb\n")
    status, _, error = run(
        "import", old_recipe[0], tmp_path / "rows.txt", tmp_path / "old.json", "--output", tmp_path / "new"
    )
    assert status == 0
    assert "rows.txt:3: 1 value for 2 variables (imageName, groupName), the row is left out" in error
    recipe = Recipe.load(tmp_path / "new")
    assert recipe.conventions.handedness == "blender"
    assert [row.name for row in recipe.conditions] == ["a"]
    assert len(recipe.mappings.changes) == 2
    assert not (recipe.folder / "mappings.txt").exists()


def test_import_unpacks_a_zae_with_what_its_scene_names(tmp_path, run, old_recipe):
    with zipfile.ZipFile(tmp_path / "room.zae", "w") as archive:
        archive.writestr("manifest.xml", "<dae_root>inner/room.dae</dae_root>")
        archive.write(old_recipe[0], "inner/room.dae")
        archive.writestr("inner/images/wood.png", "wood")
    status, _, _ = run("import", tmp_path / "room.zae", "--output", tmp_path / "new")
    recipe = Recipe.load(tmp_path / "new")
    assert status == 0
    assert (recipe.folder / "parent.dae").read_bytes() == old_recipe[0].read_bytes()
    assert recipe.find_file("./images/wood.png").read_text() == "wood"


def test_import_reads_nothing_outside_the_named_folders(tmp_path, run, old_recipe):
    parent, conditions, mappings = old_recipe
    (tmp_path / "secret.spd").write_text("400 1\n")
    (parent.parent / "link.spd").symlink_to(tmp_path / "secret.spd")
    text = mappings.read_text().replace("far.spd", "link.spd").replace("D65.spd", "../secret.spd")
    mappings.write_text(text.replace("beside.spd", str(tmp_path / "secret.spd")))
    _, _, error = run("import", parent, conditions, mappings, "--output", tmp_path / "new")
    assert "link.spd was not found" in error
    assert "../secret.spd was not found" in error
    assert not list((tmp_path / "new").rglob("secret.spd"))
    assert not list((tmp_path / "new").rglob("link.spd"))


def test_a_worker_that_was_started_early_does_not_outlive_a_recipe_that_is_wrong(write_family, run):
    assert run("render", write_family({"a": "nowhere.spd"}).folder)[0] == 2
    children = Path(f"/proc/{os.getpid()}/task").glob("*/children")
    assert not [file for file in children if file.read_text().split()]


def test_help_imports_nothing_that_takes_a_while():
    code = "import sys; from rtb_addon.__main__ import main; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
