"""
A real Blender with the extension installed from its zip, in a user folder of its own.

The Blender is $BLENDER, or the one that ../shared/bin/install-blender installs where that exists.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).parent
PICTURES = ROOT / "build/screenshots"
INSTALLER = ROOT.parent / "shared/bin/install-blender"
SCREEN = "1280x800x24"  # nothing may be cut off in a window as small as this
MISSING = "NO REAL BLENDER: the room tests/gui did not run; set BLENDER to a Blender 5.2 program"


class RealBlender(NamedTuple):
    """A Blender program and the environment to start it in."""

    program: Path
    environment: dict[str, str]

    def run(self, *arguments: str, timeout: float = 300) -> subprocess.CompletedProcess:
        """Run Blender with factory settings for everything but the extension, and return how it went."""
        command = [str(self.program), *arguments]
        return subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=timeout, check=False
        )

    def run_script(
        self, script: str, report: Path, *arguments: str, window: bool, simulated: bool = True
    ) -> dict:
        """
        Run one of this folder's scripts, in a window or without, and return its report.

        Parameters
        ----------
        simulated : whether the window's events come from the script, and no others do
        """
        mode = (["--enable-event-simulate"] if simulated else []) if window else ["-b"]
        finished = self.run(
            *mode, "--python-exit-code", "3", "--python", str(HERE / script), "--", str(report), *arguments
        )
        said = f"{finished.stdout}\n{finished.stderr}"
        assert report.is_file(), said
        found = json.loads(report.read_text())
        assert finished.returncode == 0, f"{found.get('traceback', '')}\n{said}"
        return found


def find_program() -> Path | None:
    """Return the Blender program, installing one where that can be done."""
    if blender := os.environ.get("BLENDER"):
        return Path(blender)
    if INSTALLER.is_file():
        subprocess.run([str(INSTALLER)], check=False)
    program = Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "rtb-blender/bin/blender"
    return program if program.is_file() else None


@pytest.fixture(scope="session")
def blender(tmp_path_factory) -> RealBlender:
    """Return a real Blender with the zip installed and enabled."""
    if (program := find_program()) is None:
        _missing.append(MISSING)
        pytest.skip(MISSING)
    folder = tmp_path_factory.mktemp("blender-user")
    real = RealBlender(program, {**os.environ, "BLENDER_USER_RESOURCES": str(folder), "RTB_SCREEN": SCREEN})
    archive = build_zip(real, tmp_path_factory.mktemp("dist"))
    installed = real.run("--command", "extension", "install-file", "-r", "user_default", "-e", str(archive))
    assert (folder / "extensions/user_default/render_toolbox/blender_manifest.toml").is_file(), (
        installed.stderr
    )
    shutil.rmtree(PICTURES, ignore_errors=True)
    return real


@pytest.fixture(scope="module")
def report(request, blender, tmp_path_factory) -> dict:
    """What the script of a test module, SCRIPT, found out, in a window where it says so."""
    script, window = request.module.SCRIPT, getattr(request.module, "WINDOW", False)
    folder = tmp_path_factory.mktemp(script.removesuffix(".py"))
    pictures = [str(PICTURES)] if window else []
    found = blender.run_script(script, folder / "report.json", str(folder / "home"), *pictures, window=window)
    if "seconds" in found:
        _took.append(f"{script} took {found['seconds']:.0f} s between its first click and its last")
    return found


@pytest.fixture
def shows(report):
    """Return how to ask whether a photograph is there and shows something."""
    return lambda name: (PICTURES / f"{name}.png").is_file() and report["colours"][name] > 500


def build_zip(real: RealBlender, folder: Path) -> Path:
    """Build the zip for a Blender's own Python and return it."""
    script = ROOT / "packaging/build_extension.py"
    python = real.run(
        "-b", "--factory-startup", "--python-expr", "import sys; print('py', *sys.version_info[:2])"
    )
    version = next(line.split()[1:] for line in python.stdout.splitlines() if line.startswith("py "))
    command = [sys.executable, str(script), "--python", ".".join(version), "--output", str(folder)]
    built = subprocess.run(command, capture_output=True, text=True, check=False)
    assert built.returncode == 0, built.stderr
    return next(folder.glob("*.zip"))


_missing: list[str] = []
_took: list[str] = []


def pytest_terminal_summary(terminalreporter):
    """Say how long a person's way took, and loudly, at the very end, that this room could not run."""
    for line in _took:
        terminalreporter.write_line(line)
    if _missing:
        terminalreporter.section(_missing[0], sep="!", red=True, bold=True)
