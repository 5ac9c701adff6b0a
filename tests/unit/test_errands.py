import os
import signal
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

from rtb_addon.background import Event
from rtb_addon.batch import idle_workers, render_recipe
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


def pids_of(recipe):
    """Return the workers that rendered a family, by a renderer that notes its process."""
    return {int(file.read_text()) for file in recipe.folder.glob("scenes/plain/*.pid")}


def test_a_worker_stays_warm_from_errand_to_errand_and_goes_with_its_batch(write_family, plugin):
    plugin.setenv("PLAIN_PIDS", "1")
    recipe = write_family({"a": "0.1", "b": "0.2", "c": "0.3", "d": "0.4"})
    with ThreadPoolExecutor(1) as engine:
        first = [event.kind for event in render_recipe(recipe.folder, executor=engine)]
        assert first.count("done") == 4
        assert len(pids_of(recipe)) == 1
        assert not workers_of(os.getpid())
        list(render_recipe(recipe.folder, executor=engine, conditions=["a"], fresh=True))
        assert len(pids_of(recipe)) == 2  # a batch may find other files than the last


def test_a_warm_worker_that_died_meanwhile_is_replaced(write_family, plugin):
    plugin.setenv("PLAIN_PIDS", "1")
    recipe = write_family({"a": "0.1", "b": "0.2"})
    with ThreadPoolExecutor(1) as engine:
        for event in render_recipe(recipe.folder, executor=engine):
            if event.kind == "done" and event.condition == "a":
                os.kill(pids_of(recipe).pop(), signal.SIGKILL)
            assert event.kind != "failed"
    assert recipe.rendering_file(recipe.conditions["b"]).is_file()


@pytest.fixture
def meeting(tmp_path):
    """A batch's folder, which is there until the test ends."""
    folder = tmp_path / "meeting"
    folder.mkdir()
    yield folder
    idle_workers.dismiss(str(folder))


def errand_for(recipe, meeting):
    """Render a condition for a batch that is elsewhere; return how that ended."""
    task = Task(str(recipe.folder), "a", fresh=True)
    return Event.from_json(run_errand(task.to_json(), str(meeting))).kind


def wait_until_no_worker_is_left(seconds=2):
    end = time.monotonic() + seconds
    while workers_of(os.getpid()):
        assert time.monotonic() < end
        time.sleep(0.02)


def test_an_idle_worker_of_a_batch_that_vanished_stops_by_itself(write_family, plugin, meeting):
    assert errand_for(write_family({"a": "0.5"}), meeting) == "done"
    assert len(workers_of(os.getpid())) == 1
    meeting.rename(meeting.with_name("over"))
    wait_until_no_worker_is_left()


def test_an_idle_worker_does_not_wait_for_ever(write_family, plugin, meeting, monkeypatch):
    monkeypatch.setattr(idle_workers, "PATIENCE", 0.2)
    recipe = write_family({"a": "0.5"})
    assert errand_for(recipe, meeting) == "done"
    wait_until_no_worker_is_left()
    assert errand_for(recipe, meeting) == "done"


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
    meeting.rename(meeting.with_name("over"))
    began = time.monotonic()
    errand.join(timeout=5)
    assert time.monotonic() - began < 1.2
    assert Event.from_json(ends[0]).kind == "cancelled"
    assert not recipe.rendering_file(recipe.conditions["a"]).exists()
    assert not meeting.exists()
