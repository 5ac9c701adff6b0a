"""The manifest and the wheels of the extension zip; building one for real is tests/gui's part."""

import importlib.util
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).resolve().parents[2]
MANIFEST = tomllib.loads((ROOT / "blender_manifest.toml").read_text())
BLENDERS_TAGS = """3D View, Add Curve, Add Mesh, Animation, Bake, Camera, Compositing, Development,
    Game Engine, Geometry Nodes, Grease Pencil, Import-Export, Lighting, Material, Modeling, Mesh, Node,
    Object, Paint, Pipeline, Physics, Render, Rigging, Scene, Sculpt, Sequencer, System, Text Editor,
    Tracking, User Interface, UV"""


def script(name: str):
    """Import one of packaging/'s scripts."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "packaging" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


wheels = script("wheels")
build_extension = script("build_extension")
LINUX = wheels.Target("3.11", "linux-x64", "1.26.4")


def wheel(folder: Path, name: str, *requirements: str) -> Path:
    """Write a wheel that holds nothing but what it needs."""
    from zipfile import ZipFile

    project, version = name.split("-")[:2]
    with ZipFile(folder / name, "w") as archive:
        lines = [f"Name: {project}", f"Version: {version}", *(f"Requires-Dist: {r}" for r in requirements)]
        archive.writestr(f"{project}-{version}.dist-info/METADATA", "\n".join(lines) + "\n\n")
    return folder / name


def test_the_manifest_has_only_tags_that_blender_knows():
    known = {" ".join(tag.split()) for tag in BLENDERS_TAGS.split(",")}
    assert set(MANIFEST["tags"]) <= known


def test_the_manifest_keeps_the_lengths_and_endings_of_the_platform():
    for sentence in (MANIFEST["tagline"], *MANIFEST["permissions"].values()):
        assert len(sentence) <= 64
        assert sentence[-1].isalnum() or sentence[-1] in ")]}"


def test_the_extension_and_the_library_have_one_version():
    assert MANIFEST["version"] == tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]


def test_a_wheel_of_the_right_python_and_platform_is_chosen_the_newest_first(tmp_path):
    for name in (
        "lxml-6.0.0-cp311-cp311-manylinux_2_17_x86_64.whl",
        "lxml-6.1.0-cp311-cp311-manylinux_2_28_x86_64.whl",
        "lxml-6.2.0-cp314-cp314-manylinux_2_28_x86_64.whl",
        "lxml-6.3.0-cp311-cp311-win_amd64.whl",
        "lxml-7.0.0-cp311-cp311-manylinux_2_28_x86_64.whl",
    ):
        wheel(tmp_path, name)
    chosen = wheels.wheel_of(Requirement("lxml<7"), LINUX, tmp_path)
    assert chosen.name == "lxml-6.1.0-cp311-cp311-manylinux_2_28_x86_64.whl"


def test_what_a_wheel_needs_comes_along_but_never_numpy(tmp_path, monkeypatch):
    monkeypatch.setattr(
        wheels, "library_requirements", lambda: [Requirement("a>=1"), Requirement("numpy>=1.26")]
    )
    wheel(
        tmp_path,
        "a-1.0-py3-none-any.whl",
        "b==2",
        "numpy>=1.20",
        "c; python_version >= '3.12'",
        "d; extra == 'x'",
    )
    wheel(tmp_path, "b-2-py3-none-any.whl", "a")
    assert [path.name for path in wheels.wheels_for(LINUX, tmp_path)] == [
        "a-1.0-py3-none-any.whl",
        "b-2-py3-none-any.whl",
    ]


def test_a_wheel_that_refuses_blenders_numpy_stops_the_build(tmp_path, monkeypatch):
    monkeypatch.setattr(wheels, "library_requirements", lambda: [Requirement("a")])
    wheel(tmp_path, "a-1.0-py3-none-any.whl", "numpy>=2")
    with pytest.raises(SystemExit, match=r"numpy>=2 refuses the numpy 1\.26\.4 that Blender ships"):
        wheels.wheels_for(LINUX, tmp_path)


@pytest.mark.parametrize("python", build_extension.BLENDERS)
def test_each_python_gets_a_manifest_with_its_own_blenders(python):
    text = build_extension.extension_manifest(python, "linux-x64", [Path("a-1.0-py3-none-any.whl")])
    manifest = tomllib.loads(text)
    first, end, _ = build_extension.BLENDERS[python]
    assert (manifest["blender_version_min"], manifest.get("blender_version_max")) == (first, end)
    assert manifest["wheels"] == ["./wheels/a-1.0-py3-none-any.whl"]
    assert manifest["platforms"] == ["linux-x64"]
    assert {key: manifest[key] for key in ("id", "version", "permissions")} == {
        key: MANIFEST[key] for key in ("id", "version", "permissions")
    }
