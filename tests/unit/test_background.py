import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rtb_addon import background
from rtb_addon.background import (
    Event,
    EventStream,
    send,
    start_child,
    start_early,
    stop,
    stop_early,
)
from rtb_addon.child_environment import import_folders
from rtb_addon.processes import runs

SITTER = """
import sys, threading
from rtb_addon.lifeline import watch_parent
from rtb_addon.background import Event
gone = threading.Event()
watch_parent(lambda line: print(Event("progress", message=line.strip()).to_json(), flush=True), gone.set, 9)
print("a library says hello", flush=True)
print(Event("started").to_json(), flush=True)
print("last words", file=sys.stderr, flush=True)
gone.wait(60)
"""


@pytest.fixture
def sitter(tmp_path, monkeypatch):
    """Start children that echo their lines as events and sit there until their parent leaves."""
    (tmp_path / "sitter.py").write_text(SITTER)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    children = []

    def start():
        children.append(start_child([], module="sitter"))
        return children[-1]

    yield start
    for child in children:
        stop(child, 0)


def wait_for(condition, seconds=5.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.01)


def events_until(stream, kind):
    events = []
    wait_for(lambda: events.extend(stream.ready()) or any(event.kind == kind for event in events))
    return events


def test_an_event_survives_writing_and_reading():
    event = Event(
        "failed", "red", "plain", 0.5, 3, 24, 1.5, "no lamp", "", "recipe", "a/b.exr", 2.0, ("odd",)
    )
    assert Event.from_json(event.to_json()) == event
    assert "\n" not in event.to_json()


def test_an_event_of_a_later_version_is_read_without_its_additions():
    assert Event.from_json('{"kind": "done", "condition": "red", "mood": "good"}') == Event("done", "red")


def test_a_child_tells_events_and_hears_lines(sitter):
    child = sitter()
    stream = EventStream(child)
    events_until(stream, "started")
    assert send(child, "hello")
    assert events_until(stream, "progress")[-1].message == "hello"


def test_what_is_no_event_is_passed_over_and_last_words_are_kept(sitter):
    child = sitter()
    stream = EventStream(child)
    assert [event.kind for event in events_until(stream, "started")] == ["started"]
    stop(child)
    wait_for(lambda: stream.ready() == [] and stream.ended)
    assert stream.last_words() == "last words"


def test_a_child_stops_when_its_input_closes(sitter):
    child = sitter()
    events_until(EventStream(child), "started")
    began = time.monotonic()
    stop(child, grace=5)
    assert time.monotonic() - began < 2
    assert child.returncode == 0


def test_a_child_that_does_not_listen_is_killed_after_its_grace_time(tmp_path, monkeypatch):
    (tmp_path / "deaf.py").write_text(
        'import time; print(\'{"kind": "started"}\', flush=True); time.sleep(60)'
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    child = start_child([], module="deaf")
    events_until(EventStream(child), "started")
    began = time.monotonic()
    stop(child, grace=0.2)
    assert time.monotonic() - began < 1.5
    assert child.returncode != 0


def test_a_child_whose_parent_was_killed_stops_by_itself(tmp_path):
    (tmp_path / "sitter.py").write_text(SITTER)
    parent = subprocess.Popen(
        [
            sys.executable,
            "-c",
            "import time; from rtb_addon.background import *; c = start_child([], module='sitter');"
            "print(c.pid, flush=True); print(c.stdout.readline(), flush=True); time.sleep(60)",
        ],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": f"{Path(__file__).parents[2]}{os.pathsep}{tmp_path}"},
    )
    child = int(parent.stdout.readline())
    parent.stdout.readline()
    assert runs(child)
    parent.send_signal(signal.SIGKILL)
    parent.communicate()
    wait_for(lambda: not runs(child), seconds=2)


def test_a_child_in_our_place_says_and_ends_as_if_it_were_us():
    code = "import sys; from rtb_addon.background import run_child; sys.exit(run_child(sys.argv[1:]))"
    for words, status, said in (
        (["renderers"], 0, "tracer"),
        (["check", "nowhere"], 2, "nowhere is no recipe"),
    ):
        done = subprocess.run(
            [sys.executable, "-c", code, *words], capture_output=True, text=True, check=False, timeout=30
        )
        assert done.returncode == status
        assert said in (done.stderr if status else done.stdout)


def test_a_child_in_our_place_gets_our_ctrl_c(tmp_path):
    (tmp_path / "waiting.py").write_text(
        "import time\ntry:\n    print('waiting', flush=True)\n    time.sleep(60)\n"
        "except KeyboardInterrupt:\n    print('interrupted')\n    raise SystemExit(130)\n"
    )
    code = "import sys; from rtb_addon.background import run_child; sys.exit(run_child([], 'waiting'))"
    parent = subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": f"{Path(__file__).parents[2]}{os.pathsep}{tmp_path}"},
    )
    assert parent.stdout.readline() == "waiting\n"
    parent.send_signal(signal.SIGINT)
    assert parent.communicate(timeout=10)[0] == "interrupted\n"
    assert parent.returncode == 130


def test_a_child_imports_nothing_from_the_folder_it_is_started_in(tmp_path, monkeypatch):
    (tmp_path / "tqdm.py").write_text("raise SystemExit('a stranger ran code')")
    monkeypatch.chdir(tmp_path)
    child = start_child(["renderers"])
    output, words = child.communicate(timeout=30)
    assert child.returncode == 0, words
    assert "tracer" in output


def test_a_child_is_told_where_wheels_outside_site_packages_lie(tmp_path, monkeypatch):
    (tmp_path / "embreex").mkdir()
    (tmp_path / "embreex" / "__init__.py").touch()
    monkeypatch.syspath_prepend(str(tmp_path))
    assert str(tmp_path) in import_folders()
    assert import_folders()[0] == str(Path(__file__).parents[2])


def test_a_child_starts_from_an_extension_s_own_package_name(tmp_path):
    (tmp_path / "bl_ext").mkdir()
    (tmp_path / "bl_ext" / "render_toolbox").symlink_to(Path(__file__).parents[2])
    code = (
        "from bl_ext.render_toolbox.rtb_addon.background import start_child;"
        "child = start_child(['renderers']); print(*child.communicate())"
    )
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "tracer" in done.stdout


def test_importing_the_package_costs_nothing_and_brings_nothing():
    code = (
        "import sys, time; t = time.perf_counter(); import rtb_addon; t = time.perf_counter() - t;"
        "heavy = {'numpy', 'mitsuba', 'colour', 'lxml', 'OpenEXR', 'scipy'} & set(sys.modules);"
        "assert not heavy, heavy; assert t < 0.05, t; assert 'render_recipe' in dir(rtb_addon)"
    )
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(__file__).parents[2])


def test_every_public_name_is_there():
    import rtb_addon

    for name in rtb_addon.__all__:
        assert getattr(rtb_addon, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = rtb_addon.nonsense


def test_a_child_that_was_started_early_is_the_one_that_is_asked_for(sitter):
    start_early([], "sitter")
    early = sitter()
    stream = EventStream(early)
    assert "started" in [event.kind for event in events_until(stream, "started")]
    assert EventStream(sitter()).process.pid != early.pid


def test_a_child_that_died_early_is_replaced(sitter):
    start_early([], "sitter")
    dead = background._early["sitter", None]
    with dead:
        stop(dead, 0)
    assert EventStream(sitter()).process.pid != dead.pid


def test_a_child_that_nobody_asks_for_does_not_stay(sitter):
    start_early([], "sitter")
    early = background._early["sitter", None]
    stop_early()
    assert not runs(early.pid)
    assert background._early == {}


@pytest.mark.parametrize(
    ("does", "status", "words"),
    [
        # A lock that nobody opens, as one that a library has lost.
        ("lock = threading.Lock(); lock.acquire(); lock.acquire()", 75, "it stood still"),
        ("end = time.monotonic() + 1.5\nwhile time.monotonic() < end: pass", 0, ""),
    ],
)
def test_a_process_that_stands_still_ends_and_a_slow_one_goes_on(does, status, words):
    script = (
        "import threading, time; from rtb_addon.lifeline import watch_standstill; "
        f"watch_standstill(lambda: True, 0.5, 0.1)\n{does}"
    )
    child = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=20)
    assert child.returncode == status
    assert child.stderr.startswith(words)
    assert bool(child.stderr) == bool(words)


def test_who_has_nothing_to_do_may_stand_still():
    script = (
        "import time; from rtb_addon.lifeline import watch_standstill; "
        "watch_standstill(lambda: False, 0.3, 0.1); time.sleep(1)"
    )
    assert subprocess.run([sys.executable, "-c", script], timeout=20).returncode == 0
