"""Run in a real window without simulated events: F12 and Esc of a real keyboard, which jobs hear."""

import subprocess
import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from in_window import LONG, children
from scene import make_recipe

F12 = "96"  # a keycode: xdotool holds Alt for a name that means something else with it


def escaping(driver: Driver, folder: Path):
    """Start a rendering that nobody waits for, and press Esc."""
    make_recipe(folder, 2, "tracer", samples=LONG, size=(160, 120))
    bpy.context.scene.render.engine = "RENDERTOOLBOX"
    bpy.context.preferences.view.render_display_type = "AREA"
    yield 1.0
    for x in (400, 410):
        keyboard("mousemove", str(x), "400")
        yield 0.3
    keyboard("key", F12)
    deadline = time.monotonic() + 10
    while not (bpy.app.is_job_running("RENDER") and children()) and time.monotonic() < deadline:
        yield 0.05
    driver.report["started"] = [bpy.app.is_job_running("RENDER"), len(children()) > 0]
    yield 1.0
    begin = time.perf_counter()
    keyboard("key", "Escape")
    while (bpy.app.is_job_running("RENDER") or children()) and time.perf_counter() - begin < 10:
        yield 0.02
    driver.report["stopped after"] = time.perf_counter() - begin
    driver.report["left"] = children()


def keyboard(*words: str) -> None:
    """Do to the window what a person's hands do."""
    subprocess.run(["xdotool", *words], check=True)


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(escaping(driver, home))
