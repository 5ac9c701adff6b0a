"""
How much later Blender starts with the extension: starts with and without it, in a folder of their own.

    python benchmarks/startup.py [pairs] [--window]

Prints the median difference of the pairs and the difference of the fastest starts, as wall time and as
processor time, which does not mind what else the machine does. The goal is less than 50 ms. The first start
compiles the extension's files, which Blender pays once after each installation, and does not count.
"""

import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "packaging"))
from build_extension import find_blender  # noqa: E402
from link_extension import link_extension  # noqa: E402

EXTENSION = "bl_ext.user_default.render_toolbox"
CHECK = "import bpy; assert hasattr(bpy.types, 'RTB_PT_recipe') is {enabled}"
LEAVE = "bpy.app.timers.register(bpy.ops.wm.quit_blender)"  # once the window is drawn


def start(blender: Path, environment: dict[str, str], enabled: bool, window: bool) -> tuple[float, float]:
    """Start Blender and leave it, and return wall time and processor time [ms]."""
    code = CHECK.format(enabled=enabled) + (f"; {LEAVE}" if window else "")
    command = [str(blender), *([] if window else ["-b"]), "--factory-startup", "--python-exit-code", "1"]
    command += ["--addons", EXTENSION] if enabled else []
    spent, begin = processor_time(), time.perf_counter()
    subprocess.run(
        [*command, "--python-expr", code], env=environment, stdout=subprocess.DEVNULL, check=True, timeout=120
    )
    return 1000 * (time.perf_counter() - begin), 1000 * (processor_time() - spent)


def processor_time() -> float:
    """Return what children that have ended took [s]."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description="How much later Blender starts with the extension.")
    parser.add_argument("pairs", type=int, nargs="?", default=10)
    parser.add_argument("--window", action="store_true", help="with its interface, else in the background")
    said = parser.parse_args()
    if (blender := find_blender()) is None:
        raise SystemExit("startup: no Blender program is here, set BLENDER to one")
    with tempfile.TemporaryDirectory(prefix="rtb-startup-") as home:
        link_extension(Path(home))
        environment = {**os.environ, "BLENDER_USER_RESOURCES": home}
        start(blender, environment, True, said.window)
        pairs = [
            [start(blender, environment, enabled, said.window) for enabled in (False, True)]
            for _ in range(said.pairs)
        ]
    for number, name in enumerate(("wall time", "processor time")):
        without, ours = ([pair[enabled][number] for pair in pairs] for enabled in (0, 1))
        later = median(b - a for a, b in zip(without, ours, strict=True))
        print(
            f"startup: {later:.0f} ms more {name} (median of {said.pairs} pairs), fastest "
            f"{min(ours):.0f} ms with the extension and {min(without):.0f} ms without"
        )


if __name__ == "__main__":
    main()
