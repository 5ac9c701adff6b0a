import gc
import json
import os
import subprocess
import sys
import weakref
from pathlib import Path

import pytest

from rtb_addon.errors import RecipeError
from rtb_addon.recipe import Recipe, locks
from rtb_addon.recipe.condition_scene import remaining_lines
from rtb_addon.recipe.options import Conventions, MontageOptions, RecipeOptions
from rtb_addon.renderers.interface import NativeLine

ROOT = Path(__file__).resolve().parents[2]


def changed(recipe: Recipe, **words) -> Path:
    file = recipe.folder / "recipe.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), **words}))
    return recipe.folder


def sentence_of(folder: Path) -> str:
    with pytest.raises(RecipeError) as caught:
        Recipe.load(folder)
    return str(caught.value)


def test_a_recipe_survives_writing_and_reading(write_family):
    written = write_family({"a": "0.2", "b": "0.4"}, seed=5, camera="Camera", conventions=Conventions("rtb3"))
    read = Recipe.load(written.folder)
    assert (read.name, read.options, read.conventions) == ("family", written.options, Conventions("rtb3"))
    assert read.montage == MontageOptions()
    assert read.provenance == {"by": "a test"}
    assert [condition.name for condition in read.conditions] == ["a", "b"]


def test_unequal_bands_survive_writing_and_reading(write_family):
    written = write_family({"a": "0.2"}, centres=(450.0, 500.0, 600.0))
    read = Recipe.load(written.folder)
    assert read.options.centres == (450.0, 500.0, 600.0)
    assert list(read.options.wavelength_bands.edges) == [425.0, 475.0, 550.0, 650.0]


def test_unknown_keys_are_kept_and_reported(write_family):
    folder = changed(write_family({"a": "0.2"}), mood="good", montage={"columns": 6, "frame": 3})
    recipe = Recipe.load(folder)
    recipe.save()
    words = json.loads((folder / "recipe.json").read_text())
    assert words["mood"] == "good"
    assert words["montage"]["frame"] == 3
    assert words["montage"]["columns"] == 6
    reported = " ".join(recipe.unknown_words())
    assert "mood" in reported
    assert "montage.frame" in reported


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"format": 7}, "recipe.json: format is 7, this version reads format 1"),
        ({"format": None}, "recipe.json: format is null, this version reads format 1"),
        ({"name": "a/b"}, 'recipe.json: name is "a/b", it must be a text fit for a file\'s name'),
        ({"options": {"width": 0}}, "recipe.json: options: width is 0, it must be a whole number of pixels"),
        ({"options": {"samples": True}}, "samples is true, it must be a whole number of paths per pixel"),
        ({"options": {"bands": {"start": 400, "step": 0, "count": 3}}}, "bands is [400, 0, 3], it must be"),
        ({"options": {"bands": {"centres": [500, 400]}}}, "centres is [500, 400], it must be at least two"),
        ({"options": {"band_kind": "mode"}}, 'band_kind is "mode", it must be one of averaged, centre, mean'),
        ({"options": []}, "recipe.json: options must be an object of names and values"),
        ({"renderer": "../x"}, 'renderer is "../x", it must be a renderer\'s name'),
        ({"conventions": {"units": "cgs"}}, 'conventions: units is "cgs", it must be one of si, rtb3'),
        ({"montage": {"scale": -1}}, "montage: scale is -1, it must be a positive number, or null"),
    ],
)
def test_a_wrong_value_is_said_with_what_would_be_right(write_family, words, sentence):
    assert sentence in sentence_of(changed(write_family({"a": "0.2"}), **words))


def test_what_is_no_json_is_said_with_its_line(write_family):
    folder = write_family({"a": "0.2"}).folder
    (folder / "recipe.json").write_text('{\n"format": 1,\n"name" 3}')
    assert sentence_of(folder).startswith("recipe.json:3: ")
    assert "no recipe folder" in sentence_of(folder.parent)


def test_the_command_line_wins_over_the_row_and_the_row_over_the_recipe(write_family):
    recipe = write_family({"a": "0.2"}, width=10, height=20, samples=3)
    table = "imageName\timageWidth\timageHeight\trenderer\tcamera\n"
    (recipe.folder / "conditions.txt").write_text(table + "a\t30 7\t40\tTracer\tEye\n")
    recipe = Recipe.load(recipe.folder)
    options = recipe.options_of(recipe.conditions["a"])
    row = (options.width, options.height, options.renderer, options.camera, options.samples)
    assert row == (30, 40, "tracer", "Eye", 3)
    said = recipe.overridden(width=50, samples=9, renderer="plain", height=None)
    options = said.options_of(said.conditions["a"])
    assert (options.width, options.height, options.renderer, options.samples) == (50, 40, "plain", 9)
    assert said.rendering_file(said.conditions["a"]) == recipe.folder / "renderings/plain/a.exr"


def test_a_size_that_is_no_number_is_said_with_its_row(write_family):
    recipe = write_family({"a": "0.2"})
    (recipe.folder / "conditions.txt").write_text("imageName\timageWidth\na\twide\n")
    recipe = Recipe.load(recipe.folder)
    with pytest.raises(RecipeError, match=r'conditions.txt:2: width is "wide", it must be a whole number'):
        recipe.options_of(recipe.conditions["a"])


def test_the_command_line_and_the_row_win_over_native_lines(write_family):
    recipe = write_family({"a": "0.2"})
    (recipe.folder / "conditions.txt").write_text("imageName\timageWidth\na\t30\n")
    recipe = Recipe.load(recipe.folder).overridden(samples=9)
    texts = [
        "Camera-camera_sampler:sampleCount.integer = 64",
        "Camera-camera_film:width.integer = 10",
        "Camera-camera_film:height.integer = 10",
        "integrator:maxDepth.integer = 4",
        "Camera-camera:name.string = sampleCount",
    ]
    lines = [NativeLine(text, "mappings.txt", 1) for text in texts]
    assert [line.text for line in remaining_lines(recipe, recipe.conditions["a"], lines)] == texts[2:]


def test_files_are_found_in_resources_first_then_in_the_folder_then_by_base_name(write_family):
    recipe = write_family({"a": "0.2"}, resources={"x.spd": b"400 1\n", "deep/z.spd": b"400 3\n"})
    (recipe.folder / "x.spd").write_text("400 2\n")
    (recipe.folder / "y.spd").write_text("400 2\n")
    (recipe.folder / "renderings").mkdir()
    (recipe.folder / "renderings" / "w.spd").write_text("400 2\n")
    recipe = Recipe.load(recipe.folder)
    resources = recipe.folder / "resources"
    assert recipe.find_file("x.spd") == resources / "x.spd"
    assert recipe.find_file("resources/x.spd") == resources / "x.spd"
    assert recipe.find_file("y.spd") == recipe.folder / "y.spd"
    assert recipe.find_file("z.spd") == resources / "deep" / "z.spd"
    for nothing in ("w.spd", "0.5", "300:0.5 800:0.75", "", "a" * 5000, "nul\0.spd"):
        assert recipe.find_file(nothing) is None


@pytest.mark.parametrize(
    "name", ["/etc/hostname", "../secret.spd", "a/../../secret.spd", r"C:\x.spd", r"..\x.spd"]
)
def test_a_name_that_leads_outside_is_refused(write_family, name):
    recipe = write_family({"a": "0.2"})
    (recipe.folder.parent / "secret.spd").write_text("400 1\n")
    with pytest.raises(RecipeError, match="lies outside the recipe's folder"):
        recipe.find_file(name)


def test_an_absolute_name_finds_the_file_of_its_base_name_inside(write_family):
    recipe = write_family({"a": "0.2"}, resources={"stone.png": b"png"})
    for name in ("/home/me/stone.png", r"C:\pictures\stone.png", "file:///tmp/stone.png", "../stone.png"):
        assert recipe.find_file(name) == recipe.folder / "resources" / "stone.png"


def test_a_link_that_leads_outside_is_refused(write_family):
    recipe = write_family({"a": "0.2"})
    (recipe.folder.parent / "secret.spd").write_text("400 1\n")
    (recipe.folder / "resources").mkdir(exist_ok=True)
    (recipe.folder / "resources" / "link.spd").symlink_to(recipe.folder.parent / "secret.spd")
    with pytest.raises(RecipeError, match="leads outside"):
        recipe.find_file("link.spd")


def test_a_spectrum_that_old_recipes_could_rely_on_is_put_into_resources_with_a_warning(write_family):
    recipe = write_family({"a": "0.2"})
    file = recipe.find_file("mccBabel-1.spd")
    assert file == recipe.folder / "resources" / "mccBabel-1.spd"
    assert file.read_text().startswith("380 ")
    sentence = "the library's own went into resources/ for what the recipe lacked: mccBabel-1.spd"
    assert recipe.resources.warnings == [sentence]
    assert recipe.find_file("elsewhere/../../D65.spd") == recipe.folder / "resources" / "D65.spd"


def test_a_locked_folder_is_refused_by_name_of_the_holder(write_family):
    recipe = write_family({"a": "0.2"})
    with locks.locked(recipe.folder):
        for refused in (recipe.save, lambda: locks.locked(recipe.folder).__enter__()):
            with pytest.raises(
                RecipeError, match=rf"process {os.getpid()} on .* has been rendering .* since"
            ):
                refused()
    recipe.save()
    assert not (recipe.folder / locks.NAME).exists()


def test_a_dead_process_s_lock_is_taken_over(write_family):
    folder = write_family({"a": "0.2"}).folder
    code = (
        "import sys, os, pathlib; from rtb_addon.recipe.locks import locked;"
        "lock = locked(pathlib.Path(sys.argv[1])); lock.__enter__(); os._exit(9)"
    )
    subprocess.run([sys.executable, "-c", code, str(folder)], cwd=ROOT, check=False)
    assert (folder / locks.NAME).exists()
    with locks.locked(folder):
        assert locks.holder(folder).pid == os.getpid()


def test_a_lock_of_a_process_number_that_was_given_again_is_taken_over(write_family):
    folder = write_family({"a": "0.2"}).folder
    holder = locks.Holder.here()._replace(born="some boot 1")
    (folder / locks.NAME).write_text(json.dumps(holder._asdict()))
    assert locks.holder(folder) is None
    with locks.locked(folder):
        pass


def test_a_lock_of_another_computer_counts(write_family):
    folder = write_family({"a": "0.2"}).folder
    holder = locks.Holder(1, "elsewhere", "", "2026-01-01 00:00:00")
    (folder / locks.NAME).write_text(json.dumps(holder._asdict()))
    with pytest.raises(RecipeError, match=r"process 1 on elsewhere .*delete batch.lock"):
        locks.refuse_if_locked(folder)


def test_every_problem_is_said_not_only_the_first(write_family):
    recipe = write_family({"a": "0.2", "b": "nowhere.spd", "c": "0.4"}, renderer="plain")
    (recipe.folder / "conditions.txt").write_text(
        "imageName\tpaint\timageWidth\trenderer\na\t0.2\twide\tplain\nb\tnowhere.spd\t4\tplain\nc\t0.4\t4\tpovray\n"
    )
    sentences = [str(problem) for problem in Recipe.load(recipe.folder).problems()]
    assert len(sentences) == 3
    assert any("conditions.txt:2" in sentence and "width" in sentence for sentence in sentences)
    assert any("nowhere.spd" in sentence for sentence in sentences)
    assert any("povray" in sentence and "plain" in sentence for sentence in sentences)


def test_a_good_recipe_has_no_problems(write_family):
    assert write_family({"a": "0.2", "b": "400:0.1 700:0.9"}).problems() == []


def test_of_many_parent_scenes_only_the_last_few_are_kept(write_family):
    recipe = write_family({"a": "0.2"})
    names = [f"scene{number:02}.dae" for number in range(20)]
    for name in names:
        (recipe.folder / name).write_bytes((recipe.folder / "parent.dae").read_bytes())
    rows = "".join(f"c{number:02}\t0.2\t{name}\n" for number, name in enumerate(names))
    (recipe.folder / "conditions.txt").write_text("imageName\tpaint\tcolladaFile\n" + rows)
    recipe = Recipe.load(recipe.folder)
    scenes = [weakref.ref(recipe.parent_of(condition)) for condition in recipe.conditions]
    gc.collect()
    alive = [scene() is not None for scene in scenes]
    assert alive == [False] * 16 + [True] * 4
    last = recipe.conditions["c19"]
    assert recipe.parent_of(last) is recipe.parent_of(last)


def test_options_are_checked_when_they_are_born():
    with pytest.raises(ValueError, match="depth is 0"):
        RecipeOptions(depth=0)
    assert RecipeOptions(integrator="direct", depth=9).light_paths.depth == 2
    assert Conventions("rtb3").factor == pytest.approx(0.07957747154594767, rel=1e-15)
