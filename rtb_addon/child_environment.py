"""What a child process of ours is told by its environment: where to import from, and who its parent is."""

from __future__ import annotations

import importlib.util
import os
import site
import threading
from collections.abc import Sequence
from pathlib import Path

# What our children import and an extension brings in wheels of its own.
_DEPENDENCIES = ("numpy", "lxml", "OpenEXR", "colour", "tqdm", "mitsuba", "drjit", "embreex", "llvm")
_THREAD_COUNTS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")


def child_environment(threads: int | None, folders: Sequence[str]) -> dict[str, str]:
    """
    Return the environment of a child of ours.

    Parameters
    ----------
    threads : what numerical libraries may use; None leaves it to them
    folders : further ones that it imports from
    """
    inherited = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    paths = dict.fromkeys([*import_folders(), *folders, *inherited])
    # Linux ties a child to the thread that started it: only the main one lives as long as the process.
    bound = threading.current_thread() is threading.main_thread()
    ours = {
        "PYTHONPATH": os.pathsep.join(filter(None, paths)),
        "RTB_PARENT": "process" if bound else "pipe",
    }
    counts = dict.fromkeys(_THREAD_COUNTS, str(threads)) if threads else {}
    return {**os.environ, **counts, **ours}


def import_folders() -> list[str]:
    """Return the folders that a child must be told to import from."""
    folders = [str(Path(__file__).resolve().parents[1])]
    own = {os.path.realpath(folder) for folder in site.getsitepackages()}
    for name in _DEPENDENCIES:
        spec = importlib.util.find_spec(name)
        places = list(spec.submodule_search_locations or ()) if spec else []
        places = places or ([spec.origin] if spec and spec.origin else [])
        folders += [str(Path(place).parent) for place in places[:1]]
    return [folder for folder in dict.fromkeys(folders) if os.path.realpath(folder) not in own]
