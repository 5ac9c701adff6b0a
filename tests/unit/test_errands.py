import os
import shutil
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from rtb_addon.background import Event
from rtb_addon.batch import render_recipe
from rtb_addon.batch.errand import run_errand
from rtb_addon.errors import RenderingError
from rtb_addon.worker import Task


def workers_of(pid):
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    children = [child for task in tasks for child in task.read_text().split()]
    return [child for child in children if b"rtb_addon.worker" in Path(f"/proc/{child}/cmdline").read_bytes()]


def kinds_of(events, name):
    return [event.kind for event in events if event.condition == name]


@pytest.fixture
def engine():
    """An engine with two hands, which ends with the test."""
    with ThreadPoolExecutor(2) as pool:
        yield pool


def test_any_executor_renders_a_family_and_tells_the_same_events(write_family, plugin, engine):
    plugin.setenv("PLAIN_PASS", "0.02")
    recipe = write_family({"a": "0.2", "b": "0.4", "dies": "0.5", "fails": "0.6"}, samples=40)
    events = list(render_recipe(recipe.folder, executor=engine))
    assert (events[0].kind, events[0].total, events[-1].kind, events[-1].finished) == (
        "started",
        4,
        "finished",
        4,
    )
    for name in "ab":
        kinds = kinds_of(events, name)
        assert (kinds[0], kinds[-1]) == ("started", "done")
        assert "progress" in kinds
        assert recipe.rendering_file(recipe.conditions[name]).is_file()
    said = {event.condition: event.message for event in events if event.kind == "failed"}
    assert said["fails"] == "the lamp is broken"
    assert said["dies"].startswith("its worker died twice, killed by SIGKILL, saying: LLVM ERROR")
    assert events[-1].remaining == 0
    assert not (recipe.folder / ".under-way").exists()
    assert not workers_of(os.getpid())
    again = list(render_recipe(recipe.folder, conditions=["a", "b"], executor=engine))
    assert [event.kind for event in again] == ["started", "cached", "cached", "finished"]


def test_cancelling_ends_errands_on_any_engine_within_a_second(write_family, plugin, engine):
    plugin.setenv("PLAIN_PASS", "0.05")
    recipe = write_family({"deaf": "0.5", "slow": "0.5", "late": "0.5"}, samples=1000)
    asked, last = [], None
    for last in render_recipe(recipe.folder, executor=engine, cancelled=lambda: bool(asked)):
        if last.kind == "progress" and not asked:
            asked.append(time.monotonic())
    assert time.monotonic() - asked[0] < 1.2
    assert last.kind == "cancelled"
    assert not workers_of(os.getpid())


class Lossy:
    """An engine that loses one task and forgets the other."""

    def submit(self, function, words, meeting):
        future = Future()
        if Task.from_json(words).condition == "lost":
            future.set_exception(ConnectionError("the machine\nis gone"))
        else:
            future.cancel()
            future.set_running_or_notify_cancel()
        return future


def test_what_an_engine_loses_or_cancels_has_failed_in_one_sentence(write_family):
    recipe = write_family({"lost": "0.5", "dropped": "0.5"})
    failed = [event for event in render_recipe(recipe.folder, executor=Lossy()) if event.kind == "failed"]
    assert {event.condition: event.message for event in failed} == {
        "lost": "the engine lost it: ConnectionError: the machine is gone",
        "dropped": "the engine cancelled it",
    }


def test_an_engine_that_was_shut_down_is_one_sentence(write_family):
    engine = ThreadPoolExecutor(1)
    engine.shutdown()
    recipe = write_family({"a": "0.5"})
    with pytest.raises(RenderingError, match="the executor takes no tasks: cannot schedule new futures"):
        list(render_recipe(recipe.folder, executor=engine))
    assert not (recipe.folder / ".under-way").exists()
    assert not (recipe.folder / "batch.lock").exists()


def test_an_errand_on_a_machine_that_does_not_see_the_folder_says_so(tmp_path):
    task = Task(str(tmp_path / "elsewhere"), "a")
    end = Event.from_json(run_errand(task.to_json(), str(tmp_path)))
    assert (end.kind, end.fault) == ("failed", "rendering")
    assert "it must lie on a disk that all machines share" in end.message


def test_an_errand_whose_batch_is_gone_stops_by_itself(write_family, plugin, tmp_path):
    plugin.setenv("PLAIN_PASS", "0.05")
    recipe = write_family({"a": "0.5"}, samples=1000)
    meeting = tmp_path / "meeting"
    meeting.mkdir()
    ends = []
    task = Task(str(recipe.folder), "a").to_json()
    errand = threading.Thread(target=lambda: ends.append(run_errand(task, str(meeting))))
    errand.start()
    while not list(meeting.glob("a.json")):
        time.sleep(0.01)
    shutil.rmtree(meeting)
    began = time.monotonic()
    errand.join(timeout=5)
    assert time.monotonic() - began < 1.2
    assert Event.from_json(ends[0]).kind == "cancelled"
    assert not recipe.rendering_file(recipe.conditions["a"]).exists()
    assert not meeting.exists()
