"""
Build the extension zip with its wheels, for one Python of Blender's and one platform.

    python packaging/build_extension.py                 for this Python, and for $BLENDER's if there is one
    python packaging/build_extension.py --python 3.14   for that one

Leaves ``dist/render_toolbox-VERSION-PYTHON-PLATFORM.zip``. Wheels stay in ``wheels/``, so that a
second build needs no network.
"""

from __future__ import annotations

import argparse
import importlib.util
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

from wheels import ROOT, SYSTEMS, Target, wheels_for

WHEELS = ROOT / "wheels"
INSIDE = ("__init__.py", "LICENSE", "operators", "panels", "rtb_addon")
# Python in Blender -> the first Blender that has it, the first that has it no more, the numpy in it.
# 3.14 is what Linux distributions build Blender 5.2 with; Blender's own 5.1 and 5.2 have 3.13.
BLENDERS = {
    "3.11": ("4.5.0", "5.1.0", "1.26.4"),
    "3.13": ("5.1.0", None, "2.3.3"),
    "3.14": ("5.2.0", None, "2.4.0"),
}


def build(python: str, platform_name: str, output: Path) -> Path:
    """Build, check and return the zip for one Python and platform."""
    print(f"Extension for Python {python} on {platform_name}", flush=True)
    wheels = wheels_for(Target(python, platform_name, BLENDERS[python][2]), WHEELS)
    with tempfile.TemporaryDirectory(prefix="rtb-extension-") as temporary:
        stage = Path(temporary)
        fill(stage, wheels)
        make_assets(stage / "assets")
        manifest = extension_manifest(python, platform_name, wheels)
        (stage / "blender_manifest.toml").write_text(manifest)
        version = tomllib.loads(manifest)["version"]
        archive = output / f"render_toolbox-{version}-py{python.replace('.', '')}-{platform_name}.zip"
        output.mkdir(parents=True, exist_ok=True)
        extension_tool("validate", str(stage))
        extension_tool("build", "--source-dir", str(stage), "--output-filepath", str(archive))
        extension_tool("validate", str(archive))
    print(f"{archive} ({archive.stat().st_size / 1e6:.0f} MB, {len(wheels)} wheels)")
    return archive


def fill(stage: Path, wheels: list[Path]) -> None:
    """Copy what goes into the zip, and nothing else."""
    for name in INSIDE:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, stage / name, ignore=shutil.ignore_patterns("__pycache__", ".*"))
        else:
            shutil.copy2(source, stage / name)
    (stage / "wheels").mkdir()
    for wheel in wheels:
        shutil.copy2(wheel, stage / "wheels")


def make_assets(folder: Path) -> None:
    """Write the materials for the Asset Browser, by the bpy wheel or by the Blender in $BLENDER."""
    script = [str(ROOT / "packaging/make_assets.py"), "--", str(folder)]
    if importlib.util.find_spec("bpy"):
        command = [sys.executable, *script]
    elif blender := find_blender():
        command = [str(blender), "-b", "--factory-startup", "--python", *script]
    else:
        raise SystemExit("the shipped materials need Blender: run `make setup`, or set BLENDER")
    finished = subprocess.run(command, capture_output=True, text=True, check=False)
    if finished.returncode or not (folder / "spectral_materials.blend").is_file():
        raise SystemExit(f"the shipped materials cannot be made:\n{finished.stdout}{finished.stderr}")


def extension_manifest(python: str, platform_name: str, wheels: list[Path]) -> str:
    """Return the manifest with this zip's wheels, platform and Blender versions."""
    first, end, _ = BLENDERS[python]
    lines = [f'blender_version_min = "{first}"']
    lines += [f'blender_version_max = "{end}"'] if end else []
    lines += [f'platforms = ["{platform_name}"]', "wheels = ["]
    lines += [f'    "./wheels/{wheel.name}",' for wheel in wheels] + ["]"]
    text = (ROOT / "blender_manifest.toml").read_text()
    text = re.sub(r"\n\[build\].*?(?=\n\[|\Z)", "", text, flags=re.DOTALL)
    return re.sub(r"^blender_version_min = .*$", "\n".join(lines), text, flags=re.MULTILINE)


def extension_tool(*arguments: str) -> None:
    """Run Blender's own extension tool, which is plain Python and comes with the bpy wheel too."""
    finished = subprocess.run(
        [sys.executable, str(find_extension_tool()), *arguments], capture_output=True, text=True, check=False
    )
    if finished.returncode:
        raise SystemExit(f"Blender's extension tool refuses this:\n{finished.stdout}{finished.stderr}")


def find_extension_tool() -> Path:
    """Return blender_ext.py, from the bpy wheel or from the Blender in $BLENDER."""
    places = []
    if wheel := importlib.util.find_spec("bpy"):
        places += [Path(wheel.origin).parent]
    if blender := find_blender():
        places += [blender.resolve().parent, blender.resolve().parents[1] / "root/usr/share/blender"]
    for place in places:
        for tool in sorted(place.glob("**/addons_core/bl_pkg/cli/blender_ext.py")):
            return tool
    raise SystemExit("Blender's blender_ext.py is nowhere: run `make setup` (the bpy wheel), or set BLENDER")


def find_blender() -> Path | None:
    """Return the Blender program in $BLENDER, else where the tests' own Blender is, or None."""
    cache = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache"))
    candidates = [os.environ.get("BLENDER"), cache / "rtb-blender/bin/blender", shutil.which("blender")]
    return next((Path(path) for path in candidates if path and Path(path).is_file()), None)


def python_in(blender: Path) -> str:
    """Return the version of Python in a Blender program, as 3.13."""
    expression = "import sys; print('python', *sys.version_info[:2], sep='.')"
    command = [str(blender), "-b", "--factory-startup", "--python-expr", expression]
    answer = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return re.search(r"^python\.(\d+\.\d+)$", answer, re.MULTILINE)[1]


def this_platform() -> str:
    """Return Blender's name for this machine's platform."""
    here = (platform.system(), platform.machine())
    return next(
        (name for name, (system, _, machine) in SYSTEMS.items() if (system, machine) == here), "linux-x64"
    )


def default_pythons() -> list[str]:
    """Return this Python and the one in the Blender that is here, those that some Blender has."""
    blender = find_blender()
    pythons = [f"{sys.version_info[0]}.{sys.version_info[1]}", *([python_in(blender)] if blender else [])]
    return [python for python in dict.fromkeys(pythons) if python in BLENDERS]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0].strip())
    parser.add_argument("--python", choices=BLENDERS, help="default: this one, and that of $BLENDER")
    parser.add_argument("--platform", choices=SYSTEMS, default=this_platform())
    parser.add_argument("--output", type=Path, default=ROOT / "dist")
    options = parser.parse_args()
    WHEELS.mkdir(exist_ok=True)
    pythons = [options.python] if options.python else default_pythons()
    if not pythons:
        raise SystemExit(f"no Blender has this Python: choose one with --python {'|'.join(BLENDERS)}")
    for python in pythons:
        build(python, options.platform, options.output)


if __name__ == "__main__":
    main()
