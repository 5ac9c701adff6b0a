"""Run in a real window: a newcomer's ten minutes, by mouse and keys alone, photographed step by step."""

import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from in_pictures import place
from newcomers_scene import OUTPUT_TAB, fill, paint, preview, shine, take_from_library, vary
from scene import extension

PROBE = 31, 649  # the tool in the Image Editor's toolbar, from the lower left of the window [pixels]
PATH = 600, 752  # the field of the folder in the file browser
BOX = (0.53, 0.45), (0.63, 0.6)  # on the cube's right side, as shares of the picture


def ten_minutes(driver: Driver, folder: Path):
    """From the default scene to a montage of six conditions, a probed spectrum and a zip."""
    folder.mkdir(parents=True, exist_ok=True)
    yield 1.0
    begin = time.monotonic()
    for step in (paint, shine, vary, fill, preview, shrink):
        yield from step(driver)
    yield from save(driver, folder)
    for step in (render, probe, change, pack):
        yield from step(driver)
    driver.report["seconds"] = time.monotonic() - begin


def shrink(driver: Driver):
    """Ask for small pictures, where Blender has that."""
    yield from driver.click(*OUTPUT_TAB)
    yield 0.5
    yield from driver.click_on("resolution_percentage", "PROPERTIES", "WINDOW", down=131)
    yield from driver.type("10")
    yield from driver.key("RET")
    yield 0.3


def save(driver: Driver, folder: Path):
    """Ask for the renderings, which needs a file that is saved, and save it into a folder."""
    yield from press_render(driver)
    yield from driver.until(lambda: driver.area("FILE_BROWSER"))
    yield 0.5
    yield from driver.click(*PATH)
    yield from driver.key("A", ctrl=True)
    yield from driver.type(f"{folder}/")
    while not bpy.data.filepath:  # the proposal goes first, then the folder is taken, then the file saved
        yield from driver.key("RET")
        yield 0.4
    driver.report["saved"] = bpy.data.filepath
    yield 0.5


def render(driver: Driver):
    """Render all six, and watch the montage fill."""
    running = extension("operators.running")
    yield from press_render(driver)
    yield from driver.until(lambda: running.batch is not None and running.batch.finished >= 2)
    yield 0.3
    driver.photograph("newcomer-7-filling")
    yield from driver.until(lambda: running.batch is None)
    yield 1.0
    driver.photograph("newcomer-7-rendered")
    driver.report["states"] = states()


def probe(driver: Driver):
    """Take the spectrum probe from the toolbar, look, drag a box, and another one with Shift."""
    yield from driver.press("T", "IMAGE_EDITOR")
    yield 0.5
    yield from driver.click(*PROBE)
    yield 0.5
    yield from driver.move(*place(driver, "magenta", 0.57, 0.5))
    yield 0.7
    driver.photograph("newcomer-8-pointing")
    for condition, shift in (("blue", False), ("green", True)):
        begin, end = (place(driver, condition, *each) for each in BOX)
        yield from driver.drag(begin, end, shift=shift)
        yield 0.7
    driver.photograph("newcomer-8-compared")
    pins = bpy.context.window_manager.rtb_pins
    driver.report["pins"] = [[pin.name, pin.number, pin.first] for pin in pins]


def change(driver: Driver):
    """Give the active condition another patch, and render what is stale by that."""
    yield from driver.find("value", "VIEW_3D", "UI", down=588)
    yield from driver.click(1000, driver.y)
    yield 0.4
    yield from take_from_library(driver, "skin")
    driver.photograph("newcomer-9-stale")
    driver.report["changed"] = [bpy.context.scene.rtb.conditions[-1].cells[0].value, states()]
    running, before = extension("operators.running"), cubes()
    yield from press_render(driver)
    yield from driver.until(lambda: running.batch is not None)
    yield from driver.until(lambda: running.batch is None)
    yield 0.7
    driver.photograph("newcomer-9-rendered")
    driver.report["rendered anew"] = [name for name, written in cubes().items() if written != before[name]]


def pack(driver: Driver):
    """Make the zip for a colleague."""
    yield from driver.click_on("rtb.pack_recipe", "VIEW_3D", "UI", down=188)
    yield from driver.until(lambda: driver.area("FILE_BROWSER"))
    yield 0.5
    yield from driver.key("RET")
    yield 1.0
    driver.photograph("newcomer-10-packed")
    driver.report["packed"] = str(Path(bpy.data.filepath).with_suffix(".zip"))


def press_render(driver: Driver):
    """Press Render Recipe."""
    yield from driver.click_on("rtb.render_recipe", "VIEW_3D", "UI", down=112)


def cubes() -> dict[str, int]:
    """Return when each condition's cube was written [ns]."""
    folder = Path(bpy.path.abspath("//rtb/Untitled/renderings/mitsuba"))
    return {file.stem: file.stat().st_mtime_ns for file in sorted(folder.glob("*.exr"))}


def states() -> list[str]:
    """Return how each row of the table is."""
    scene, rows = bpy.context.scene, extension("operators.row_states")
    return [rows.state(scene, row, number) for number, row in enumerate(scene.rtb.conditions)]


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"  # its own window has no photograph
    driver = Driver(report_file, pictures)
    driver.run(ten_minutes(driver, home))
