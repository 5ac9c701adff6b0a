import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.batch import render_condition, render_recipe, up_to_date
from rtb_addon.errors import RecipeError
from rtb_addon.processes import runs
from rtb_addon.recipe import Recipe, locks
from rtb_addon.recipe.options import Conventions
from rtb_addon.spectral_image import SpectralImage

ROOT = Path(__file__).resolve().parents[2]


def rendered(recipe, **options):
    """Return {condition: kind} of how a batch ended for each condition."""
    events = list(render_recipe(recipe.folder, **{"jobs": 1, **options}))
    return {e.condition: e.kind for e in events if e.kind in {"done", "cached", "failed"}}


def failure(recipe, name):
    events = list(render_recipe(recipe.folder, jobs=1))
    return next(event for event in events if event.kind == "failed" and event.condition == name)


def cube(recipe, name):
    return SpectralImage.load(recipe.rendering_file(recipe.conditions[name]))


def temporaries(folder):
    return [file for file in folder.rglob("*") if ".writing" in file.name]


def workers_of(pid):
    """Return the processes that a process started."""
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def wait_for(condition, seconds):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.01)


def test_a_family_is_rendered_and_each_cube_says_where_it_comes_from(write_family):
    recipe = write_family({"light": "0.8", "dark": "400:0.1 700:0.4"})
    assert rendered(recipe) == {"light": "done", "dark": "done"}
    image = cube(recipe, "light")
    assert image.radiance.shape == (3, 4, 31)
    np.testing.assert_allclose(image.radiance, 0.8, rtol=1e-6)
    np.testing.assert_allclose(cube(recipe, "dark").radiance[0, 0, 15], 0.25, rtol=1e-6)
    words = image.attributes
    assert (words["condition"], words["renderer"], words["renderer_version"]) == ("light", "plain", "1.0")
    assert (words["units"], words["handedness"]) == ("si", "blender")
    record = json.loads(recipe.record_file(recipe.conditions["light"]).read_text())
    assert record["key"] == words["key"]
    assert record["cells"] == {"imageName": "light", "paint": "0.8"}
    assert record["options"]["samples"] == 2
    assert str(recipe.folder) not in json.dumps(record)


def test_records_and_the_log_name_files_as_the_folder_does(write_family):
    recipe = write_family({"a": "grey.spd"}, resources={"grey.spd": b"300 0.5\n800 0.5\n"})
    rendered(recipe)
    record, log = recipe.record_file(recipe.conditions["a"]).read_text(), recipe.folder / "log.jsonl"
    assert '"found": "resources/grey.spd"' in record
    done = [json.loads(line) for line in log.read_text().splitlines() if '"done"' in line]
    assert [line["file"] for line in done] == ["renderings/plain/a.exr"]
    assert str(recipe.folder) not in record + log.read_text()


def test_the_renderings_folder_holds_cubes_and_records_and_nothing_else(write_family):
    recipe = write_family({"a": "0.8"})
    rendered(recipe)
    files = sorted(file.name for file in (recipe.folder / "renderings").rglob("*") if file.is_file())
    assert files == ["a.exr", "a.json"]
    assert not temporaries(recipe.folder)


def test_what_is_done_is_not_rendered_again(write_family):
    recipe = write_family({"a": "0.8", "b": "0.4"})
    rendered(recipe)
    before = recipe.rendering_file(recipe.conditions["a"]).stat().st_mtime_ns
    assert rendered(recipe) == {"a": "cached", "b": "cached"}
    assert rendered(recipe, fresh=True) == {"a": "done", "b": "done"}
    assert recipe.rendering_file(recipe.conditions["a"]).stat().st_mtime_ns > before


def test_a_recipe_that_moved_is_still_done(write_family, tmp_path):
    recipe = write_family({"a": "paint.spd"}, resources={"paint.spd": b"300 0.5\n800 0.5\n"})
    rendered(recipe)
    shutil.move(recipe.folder, tmp_path / "elsewhere")
    assert rendered(Recipe.load(tmp_path / "elsewhere")) == {"a": "cached"}


def test_a_changed_row_renders_only_itself(write_family):
    recipe = write_family({"a": "0.8", "b": "0.4"})
    assert up_to_date(recipe) == []
    rendered(recipe)
    assert up_to_date(recipe) == ["a", "b"]
    assert up_to_date(write_family({"a": "0.8", "b": "0.5"})) == ["a"]
    assert rendered(write_family({"a": "0.8", "b": "0.5"})) == {"a": "cached", "b": "done"}


@pytest.mark.parametrize(
    "change", ["parent", "mappings", "spectrum", "options", "conventions", "version", "ours"]
)
def test_whatever_a_rendering_comes_from_renders_it_anew(write_family, plugin, change):
    recipe = write_family({"a": "paint.spd"}, resources={"paint.spd": b"300 0.5\n800 0.5\n"})
    assert rendered(recipe) == {"a": "done"}
    folder = recipe.folder
    edits = {
        "parent": (folder / "parent.dae", ">40<", ">41<"),
        "mappings": (folder / "mappings.txt", "300:10", "300:11"),
        "spectrum": (folder / "resources" / "paint.spd", "0.5", "0.6"),
        "options": (folder / "recipe.json", '"seed": 0', '"seed": 1'),
        "conventions": (folder / "recipe.json", '"si"', '"rtb3"'),
    }
    if change in edits:
        file, old, new = edits[change]
        assert old in file.read_text()
        file.write_text(file.read_text().replace(old, new))
    elif change == "version":
        plugin.setenv("PLAIN_VERSION", "1.1")
    else:
        plugin.setattr("plain_renderer.Plain.translation", 2)
        plugin.setenv("PLAIN_TRANSLATION", "2")
    assert rendered(Recipe.load(folder)) == {"a": "done"}
    assert rendered(Recipe.load(folder)) == {"a": "cached"}


def test_comments_and_spaces_in_the_mappings_render_nothing_anew(write_family):
    recipe = write_family({"a": "0.5"})
    rendered(recipe)
    file = recipe.folder / "mappings.txt"
    file.write_text("% a comment\n\n" + file.read_text())
    assert rendered(Recipe.load(recipe.folder)) == {"a": "cached"}


@pytest.mark.parametrize("damage", ["missing", "cut off", "empty", "another's"])
def test_a_cube_that_is_not_whole_or_not_its_own_is_rendered_again(write_family, damage):
    recipe = write_family({"a": "0.5", "b": "0.6"})
    rendered(recipe)
    file = recipe.rendering_file(recipe.conditions["a"])
    content = file.read_bytes()
    other = recipe.rendering_file(recipe.conditions["b"]).read_bytes()
    if damage == "missing":
        file.unlink()
    else:
        file.write_bytes({"cut off": content[: len(content) // 2], "empty": b"", "another's": other}[damage])
    assert rendered(recipe) == {"a": "done", "b": "cached"}
    np.testing.assert_allclose(cube(recipe, "a").radiance, 0.5, rtol=1e-6)


def test_units_of_old_recipes_multiply_everything_and_record_the_factor(write_family):
    recipe = write_family({"a": "0.8"}, conventions=Conventions("rtb3", "rtb3"))
    rendered(recipe)
    image = cube(recipe, "a")
    np.testing.assert_allclose(image.radiance, 0.8 / (4 * np.pi), rtol=1e-6)
    assert image.factor == pytest.approx(1 / (4 * np.pi), rel=1e-12)
    assert image.attributes["units"] == "rtb3"


def test_chosen_conditions_alone_are_rendered(write_family):
    recipe = write_family({"a": "0.8", "b": "0.4", "c": "0.2"})
    assert rendered(recipe, conditions=["c", "a"]) == {"a": "done", "c": "done"}
    with pytest.raises(RecipeError, match="no condition is called d, there are"):
        rendered(recipe, conditions=["d"])


def test_the_command_line_s_options_reach_the_workers(write_family):
    recipe = write_family({"a": "0.8"})
    assert rendered(recipe, size=(6, 5), samples=7) == {"a": "done"}
    assert cube(recipe, "a").radiance.shape == (5, 6, 31)
    assert json.loads(recipe.record_file(recipe.conditions["a"]).read_text())["options"]["samples"] == 7


def test_events_count_and_foretell(write_family, plugin):
    plugin.setenv("PLAIN_PASS", "0.02")
    recipe = write_family(dict.fromkeys("abcd", "0.5"), samples=20)
    events = list(render_recipe(recipe.folder, jobs=2))
    assert (events[0].kind, events[0].total, events[-1].kind) == ("started", 4, "finished")
    assert [event.finished for event in events if event.kind == "done"] == [1, 2, 3, 4]
    assert {event.renderer for event in events if event.condition} == {"plain"}
    assert any(0 < event.fraction < 1 for event in events if event.kind == "progress")
    foretold = [event.remaining for event in events if event.remaining is not None]
    assert foretold[-1] == 0
    assert max(foretold) < 60


def test_a_wrong_row_is_said_before_anything_is_rendered(write_family):
    recipe = write_family({"a": "0.5"})
    (recipe.folder / "conditions.txt").write_text("imageName\tpaint\timageWidth\na\t0.5\t4\nb\t0.5\twide\n")
    with pytest.raises(RecipeError, match=r"conditions.txt:3: width is"):
        list(render_recipe(recipe.folder))
    assert not (recipe.folder / "renderings").exists()
    assert not (recipe.folder / locks.NAME).exists()


def test_a_renderer_that_is_missing_is_said_with_its_reason(write_family, plugin):
    recipe = write_family({"a": "0.5"})
    plugin.setenv("PLAIN_MISSING", "its disk is in the cellar")
    with pytest.raises(
        RecipeError, match="the renderer plain cannot be used here: its disk is in the cellar"
    ):
        list(render_recipe(recipe.folder))


def test_the_batch_says_which_spectra_the_library_served(write_family):
    recipe = write_family({"a": "mccBabel-1.spd", "b": "mccBabel-2.spd"})
    first = next(iter(render_recipe(recipe.folder, jobs=1)))
    served = (
        "the library's own went into resources/ for what the recipe lacked: mccBabel-1.spd, mccBabel-2.spd"
    )
    assert first.warnings == (served,)


def test_a_failed_rendering_is_one_sentence_and_its_details_are_in_the_log(write_family):
    recipe = write_family({"fails": "0.5", "stumbles": "0.5", "good": "0.5"})
    assert rendered(recipe) == {"fails": "failed", "stumbles": "failed", "good": "done"}
    log = [json.loads(line) for line in (recipe.folder / "log.jsonl").read_text().splitlines()]
    said = {line["condition"]: line for line in log if line["what"] == "failed"}
    assert said["fails"]["message"] == "the lamp is broken"
    assert said["stumbles"]["message"] == "ZeroDivisionError: no light at all"
    assert "Traceback" in said["stumbles"]["details"]
    assert [line["what"] for line in log][0 :: len(log) - 1] == ["started", "finished"]
    assert log[0]["renderer version"] == "1.0"


def test_a_batch_survives_a_worker_that_dies_once(write_family):
    recipe = write_family({"a": "0.5", "once": "0.6", "b": "0.7", "c": "0.8"})
    assert rendered(recipe) == {"a": "done", "once": "done", "b": "done", "c": "done"}


def test_the_next_condition_begins_while_the_last_one_is_saved(write_family):
    recipe = write_family({"a": "0.5", "b": "0.6"})
    events = [(event.kind, event.condition) for event in render_recipe(recipe.folder, jobs=1)]
    assert events.index(("started", "b")) < events.index(("done", "a"))


def test_a_condition_that_was_only_to_be_saved_is_innocent_of_its_workers_death(write_family):
    recipe = write_family({"a": "0.5", "dies": "0.6", "b": "0.7"}, width=800, height=600)
    events = list(render_recipe(recipe.folder, jobs=1))
    ends = {event.condition: event.kind for event in events if event.kind in {"done", "failed"}}
    assert ends == {"a": "done", "dies": "failed", "b": "done"}
    assert {event.condition for event in events if "worker died" in event.message} == {"dies"}
    assert not temporaries(recipe.folder)


def test_a_condition_whose_worker_dies_twice_fails_with_its_last_words(write_family):
    recipe = write_family({"a": "0.5", "dies": "0.6", "b": "0.7"})
    event = failure(recipe, "dies")
    assert (
        event.message
        == "its worker died twice, killed by SIGKILL, saying: LLVM ERROR: Cannot select: fminimum"
    )
    assert rendered(recipe) == {"a": "cached", "dies": "failed", "b": "cached"}


def test_what_a_library_prints_is_no_event(write_family):
    recipe = write_family({"chatty": "0.5"})
    assert rendered(recipe) == {"chatty": "done"}
    assert recipe.rendering_file(recipe.conditions["chatty"]).is_file()


def test_killing_a_worker_in_the_middle_costs_nothing(write_family, plugin):
    plugin.setenv("PLAIN_PASS", "0.01")
    recipe = write_family(dict.fromkeys("abcd", "0.5"), samples=30)
    killed, ends = [], {}
    for event in render_recipe(recipe.folder, jobs=2):
        if event.kind == "progress" and not killed:
            killed = workers_of(os.getpid())
            os.kill(killed[0], signal.SIGKILL)
        ends[event.condition] = event.kind
    assert killed
    assert {ends[name] for name in "abcd"} == {"done"}


def test_cancelling_stops_within_a_second_even_what_does_not_listen(write_family, plugin):
    plugin.setenv("PLAIN_PASS", "0.05")
    recipe = write_family({"deaf": "0.5", "slow": "0.5", "other": "0.5"}, samples=400)
    asked = []
    events = []
    for event in render_recipe(recipe.folder, jobs=2, cancelled=lambda: bool(asked)):
        events.append(event)
        if event.kind == "progress" and not asked:
            asked.append(time.monotonic())
    assert time.monotonic() - asked[0] < 1
    assert events[-1].kind == "cancelled"
    assert not workers_of(os.getpid())
    assert not (recipe.folder / locks.NAME).exists()


def test_a_batch_can_be_cancelled_while_it_still_looks_what_is_done(write_family):
    recipe = write_family(dict.fromkeys("abcd", "0.5"))
    looks = []

    def cancelled():
        looks.append(None)
        return len(looks) > 2

    events = list(render_recipe(recipe.folder, cancelled=cancelled))
    assert [(event.kind, event.condition) for event in events] == [("started", ""), ("cancelled", "")]


def test_leaving_a_batch_early_leaves_no_worker(write_family, plugin):
    plugin.setenv("PLAIN_PASS", "0.05")
    recipe = write_family({"a": "0.5", "b": "0.5"}, samples=400)
    batch = render_recipe(recipe.folder, jobs=2)
    for event in batch:
        if event.kind == "progress":
            break
    batch.close()
    assert not workers_of(os.getpid())
    assert not (recipe.folder / locks.NAME).exists()


def batch_process(recipe):
    """Start a batch in a process of its own and return it with its workers, once they render."""
    command = [sys.executable, "-m", "rtb_addon", "render", str(recipe.folder), "--jobs", "2", "--json"]
    process = subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    for line in process.stdout:
        if json.loads(line)["kind"] == "progress":
            break
    return process, workers_of(process.pid)


def test_no_worker_outlives_a_batch_that_was_killed(write_family, plugin):
    plugin.setenv("PLAIN_PASS", "0.05")
    recipe = write_family({"a": "0.5", "deaf": "0.5"}, samples=1000)
    process, workers = batch_process(recipe)
    assert len(workers) == 2
    process.kill()
    process.communicate()
    wait_for(lambda: not any(map(runs, workers)), seconds=2)


def test_one_condition_can_be_rendered_alone_and_again(write_family):
    recipe = write_family({"a": "0.5", "b": "0.5"})
    fractions = []
    first = render_condition(recipe.folder, "a", fractions.append)
    assert first.new
    assert fractions == [0, 0.5]
    np.testing.assert_allclose(first.image.radiance, 0.5, rtol=1e-6)
    assert not render_condition(recipe.folder, "a", fractions.append).new


def test_a_batch_in_a_folder_that_another_renders_is_refused(write_family):
    recipe = write_family({"a": "0.5"})
    with locks.locked(recipe.folder), pytest.raises(RecipeError, match="has been rendering"):
        list(render_recipe(recipe.folder))


def test_finding_a_condition_done_takes_under_two_milliseconds(write_family):
    names = [f"c{number:03}" for number in range(200)]
    recipe = write_family(dict.fromkeys(names, "0.5"), width=1, height=1, bands=(400.0, 100.0, 3), samples=1)
    for name in names:
        render_condition(recipe, name, lambda _: None)
    began = time.process_time()
    assert set(rendered(recipe).values()) == {"cached"}
    assert time.process_time() - began < 0.4
