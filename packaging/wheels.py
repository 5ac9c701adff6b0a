"""Which wheels an extension zip carries: what the library needs, resolved for one of Blender's Pythons."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Iterable
from email.parser import HeaderParser
from pathlib import Path
from typing import NamedTuple
from zipfile import ZipFile

from packaging.requirements import Requirement
from packaging.tags import Tag, compatible_tags, cpython_tags, mac_platforms
from packaging.utils import canonicalize_name, parse_wheel_filename

ROOT = Path(__file__).resolve().parents[1]


class Target(NamedTuple):
    """One Python inside Blender: its version, the platform as Blender calls it, the numpy shipped there."""

    python: str
    platform: str
    numpy: str

    def environment(self) -> dict[str, str]:
        """Return what markers such as ``python_version < '3.12'`` are read against."""
        system, sys_platform, machine = SYSTEMS[self.platform]
        return {
            "python_version": self.python,
            "python_full_version": f"{self.python}.0",
            "platform_system": system,
            "sys_platform": sys_platform,
            "platform_machine": machine,
            "implementation_name": "cpython",
            "platform_python_implementation": "CPython",
            "os_name": "nt" if system == "Windows" else "posix",
            "extra": "",
        }

    def tags(self) -> list[Tag]:
        """Return the wheel tags that install here, the best first."""
        version = tuple(int(part) for part in self.python.split("."))
        platforms = WHEEL_PLATFORMS[self.platform]
        interpreter = f"cp{version[0]}{version[1]}"
        return [
            *cpython_tags(version, platforms=platforms),
            *compatible_tags(version, interpreter, platforms),
        ]


SYSTEMS = {
    "linux-x64": ("Linux", "linux", "x86_64"),
    "windows-x64": ("Windows", "win32", "AMD64"),
    "macos-arm64": ("Darwin", "darwin", "arm64"),
    "macos-x64": ("Darwin", "darwin", "x86_64"),
}
WHEEL_PLATFORMS = {
    # Blender itself wants glibc 2.28.
    "linux-x64": [*(f"manylinux_2_{minor}_x86_64" for minor in range(28, 4, -1)), "manylinux2014_x86_64"],
    "windows-x64": ["win_amd64"],
    "macos-arm64": list(mac_platforms((14, 0), "arm64")),
    "macos-x64": list(mac_platforms((14, 0), "x86_64")),
}
# Blender ships numpy, and a second one breaks it and other extensions.
SHIPPED_BY_BLENDER = {"numpy"}
# The last colour-science that accepts the numpy 1.26 of Blender 4.5.
CONSTRAINTS = {"3.11": {"colour-science": "<0.4.7"}}


def wheels_for(target: Target, folder: Path) -> list[Path]:
    """Return the wheels of everything the library needs there, downloading into a folder what it lacks."""
    found: dict[str, Path] = {}
    waiting = library_requirements()
    while waiting:
        requirement = waiting.pop(0)
        name = canonicalize_name(requirement.name)
        if not applies(requirement, target) or name in found:
            continue
        if name in SHIPPED_BY_BLENDER:
            if not requirement.specifier.contains(target.numpy):
                raise SystemExit(f"{requirement} refuses the {name} {target.numpy} that Blender ships")
            continue
        requirement.specifier &= CONSTRAINTS.get(target.python, {}).get(name, "")
        found[name] = wheel_of(requirement, target, folder)
        waiting += requirements_of(found[name])
    return sorted(found.values())


def library_requirements() -> list[Requirement]:
    """Return what pyproject.toml says the library needs."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return [Requirement(line) for line in project["dependencies"]]


def requirements_of(wheel: Path) -> list[Requirement]:
    """Return what a wheel says it needs."""
    with ZipFile(wheel) as archive:
        metadata = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        headers = HeaderParser().parsestr(archive.read(metadata).decode())
    return [Requirement(line) for line in headers.get_all("Requires-Dist", [])]


def applies(requirement: Requirement, target: Target) -> bool:
    """Return whether a requirement is one of this target's."""
    return requirement.marker is None or requirement.marker.evaluate(target.environment())


def wheel_of(requirement: Requirement, target: Target, folder: Path) -> Path:
    """Return the wheel that meets a requirement, from the folder or downloaded into it."""
    tags = target.tags()
    if wheel := best(requirement, tags, folder.glob("*.whl")):
        return wheel
    print(f"  downloading {requirement.name} {requirement.specifier} for Python {target.python}", flush=True)
    download(requirement, target, folder)
    if wheel := best(requirement, tags, folder.glob("*.whl")):
        return wheel
    raise SystemExit(f"{requirement} has no wheel for Python {target.python} on {target.platform}")


def best(requirement: Requirement, tags: list[Tag], wheels: Iterable[Path]) -> Path | None:
    """Return the newest wheel of a requirement that these tags allow, or None."""
    allowed = set(tags)
    fitting = []
    for path in wheels:
        name, version, _, its_tags = parse_wheel_filename(path.name)
        fits = name == canonicalize_name(requirement.name) and requirement.specifier.contains(version)
        if fits and allowed & its_tags:
            fitting.append((version, path))
    return max(fitting)[1] if fitting else None


def download(requirement: Requirement, target: Target, folder: Path) -> None:
    """Let pip fetch one wheel, and only a wheel."""
    tags = target.tags()
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"]
    command += ["--no-deps", "--only-binary=:all:", "--implementation", "cp", "--dest", str(folder)]
    command += ["--python-version", target.python]
    for option, kinds in (
        ("--abi", (tag.abi for tag in tags)),
        ("--platform", (tag.platform for tag in tags)),
    ):
        for kind in dict.fromkeys(kinds):
            command += [option, kind]
    finished = subprocess.run([*command, f"{requirement.name}{requirement.specifier}"], check=False)
    if finished.returncode:
        raise SystemExit(
            f"pip found no wheel of {requirement} for Python {target.python} on {target.platform}"
        )
