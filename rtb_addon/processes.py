"""Whether a process of this computer is alive, and since when."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def born(pid: int) -> str:
    """Return when a process started, in clock ticks since this boot; empty where nobody says."""
    try:
        boot = Path("/proc/sys/kernel/random/boot_id").read_text().strip()
        return f"{boot} {_state(pid)[19]}"
    except (OSError, IndexError):
        return ""


def runs(pid: int) -> bool:
    """Return whether a process of this computer is alive."""
    if sys.platform == "win32":
        return _runs_on_windows(pid)
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    try:
        return _state(pid)[0] not in "ZX"  # dead, and only not yet buried
    except (OSError, IndexError):
        return True


def _state(pid: int) -> list[str]:
    """Return the words after a process's name, which stands in brackets and may hold anything."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def _runs_on_windows(pid: int) -> bool:
    import ctypes

    kernel = ctypes.windll.kernel32  # type: ignore[attr-defined]
    query, still_active = 0x1000, 259
    if not (process := kernel.OpenProcess(query, False, pid)):
        return False
    code = ctypes.c_ulong()
    kernel.GetExitCodeProcess(process, ctypes.byref(code))
    kernel.CloseHandle(process)
    return code.value == still_active
