"""LLVM is tried out in a child process before anybody trusts it."""

import json
import os
from pathlib import Path

import pytest

from rtb_addon.renderers.mitsuba import llvm


def test_the_llvm_that_comes_with_the_package_works(tmp_path):
    path = llvm.working(memory=tmp_path / "llvm.json")
    assert path is not None
    assert json.loads((tmp_path / "llvm.json").read_text())[llvm._key(path)] is True


def test_an_answer_is_remembered_for_this_very_library(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(llvm, "probe", lambda path: asked.append(path) or path.endswith("good.so"))
    bad, good, memory = tmp_path / "bad.so", tmp_path / "good.so", tmp_path / "cache" / "llvm.json"
    bad.write_bytes(b"1")
    good.write_bytes(b"2")
    for _ in range(2):
        assert llvm.working([str(bad), str(good)], memory) == str(good)
    assert asked == [str(bad), str(good)]
    good.write_bytes(b"another version")
    assert llvm.working([str(bad), str(good)], memory) == str(good)
    assert asked == [str(bad), str(good), str(good)]


def test_no_answer_in_time_is_not_remembered(tmp_path, monkeypatch):
    monkeypatch.setattr(llvm, "probe", lambda path: None)
    (tmp_path / "slow.so").write_bytes(b"1")
    assert llvm.working([str(tmp_path / "slow.so")], tmp_path / "llvm.json") is None
    assert not (tmp_path / "llvm.json").exists()


def test_a_memory_that_cannot_be_read_or_written_costs_only_the_probe(tmp_path, monkeypatch):
    monkeypatch.setattr(llvm, "probe", lambda path: True)
    (tmp_path / "good.so").write_bytes(b"1")
    (tmp_path / "file").write_text("{]")
    assert llvm.working([str(tmp_path / "good.so")], tmp_path / "file") is not None
    assert llvm.working([str(tmp_path / "good.so")], tmp_path / "file" / "below") is not None


@pytest.fixture
def pretend(tmp_path, monkeypatch):
    """Stand-ins for mitsuba and drjit that report a version of LLVM and note whether they were to render."""

    def make(version, dies=False):
        folder = tmp_path / "stand-ins"
        folder.mkdir(exist_ok=True)
        (folder / "drjit.py").write_text(
            f"class detail:\n    llvm_version = staticmethod(lambda: {version})\n"
        )
        end = "__import__('os').abort()" if dies else "type('I', (), {'array': [0.5]})"
        (folder / "mitsuba.py").write_text(
            "set_variant = load_dict = lambda what: what\n"
            "def render(scene, spp):\n"
            f"    open({str(tmp_path / 'rendered')!r}, 'w').close()\n"
            f"    return {end}\n"
        )
        monkeypatch.setenv("PYTHONPATH", str(folder))
        return tmp_path / "rendered"

    return make


@pytest.mark.parametrize(("version", "good"), [((15, 0, 6), False), ((16, 0, 6), False), ((19, 1, 7), True)])
def test_a_version_before_17_is_never_even_rendered_with(pretend, version, good):
    rendered = pretend(version)
    assert llvm.probe("/any/libLLVM.so") is good
    assert rendered.exists() is good


def test_a_library_that_aborts_takes_only_the_child_with_it(pretend):
    rendered = pretend((18, 1, 0), dies=True)
    assert llvm.probe("/any/libLLVM.so") is False
    assert rendered.exists()


def test_a_file_that_is_no_library_does_not_work(tmp_path):
    (tmp_path / "libLLVM.so").write_bytes(b"no library")
    assert llvm.probe(str(tmp_path / "libLLVM.so")) is False


def test_the_users_choice_comes_first_and_the_wheel_before_the_system(tmp_path, monkeypatch):
    chosen = tmp_path / "mine.so"
    chosen.write_bytes(b"1")
    monkeypatch.setenv(llvm.VARIABLE, str(chosen))
    system = tmp_path / "libLLVM-15.so.1"
    system.write_bytes(b"2")
    monkeypatch.setattr(llvm, "_in_system", lambda: [str(system)])
    found = list(llvm.candidates())
    assert found[0] == str(chosen)
    assert found[-1] == str(system)
    assert any("llvm" in Path(path).parts for path in found[1:-1])


def test_of_the_systems_the_newest_comes_first():
    names = ["/usr/lib/libLLVM-15.so.1", "/usr/lib/libLLVM.so.19.1", "/usr/lib/libLLVM-9.so"]
    ordered = sorted(map(Path, names), key=llvm._version_in_name, reverse=True)
    assert [path.name for path in ordered] == ["libLLVM.so.19.1", "libLLVM-15.so.1", "libLLVM-9.so"]


def test_preparing_points_drjit_at_the_library_that_works(monkeypatch):
    monkeypatch.setattr(llvm, "working", lambda: "/some/libLLVM.so")
    monkeypatch.setenv(llvm.VARIABLE, "/old/libLLVM-15.so.1")
    assert llvm.prepare() == "/some/libLLVM.so"
    assert os.environ[llvm.VARIABLE] == "/some/libLLVM.so"
