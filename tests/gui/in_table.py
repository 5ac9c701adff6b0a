"""Run in a real window: the table of conditions and the menu of spectra, by mouse and keys, photographed."""

import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import extension, make_recipe, measured

MANY = 1000


def looks(driver: Driver, folder: Path):
    """Look at the table: none, six rows, a dialog, a wide one, a thousand rows."""
    yield from open_sidebar(driver)
    driver.photograph("conditions-none")
    make_recipe(folder, 6, "tracer", samples=8, size=(80, 60))
    bpy.ops.rtb.add_variable(name="gloss", value="0.1")
    bpy.context.scene.rtb.active_variable = 0
    yield 0.6
    driver.photograph("conditions")
    yield from dialog(driver, "fill_from_library", "conditions-library")
    yield from dialog(driver, "fill_random", "conditions-random")
    yield from menu(driver, "RTB_MT_conditions", "conditions-menu")
    yield from scroll_many_rows(driver)


def open_sidebar(driver: Driver):
    """Show the tab RenderToolbox in the 3D Viewport's sidebar, with only the table open."""
    driver.area("VIEW_3D").spaces.active.show_region_ui = True
    yield 1.0
    driver.region("VIEW_3D", "UI").active_panel_category = "RenderToolbox"
    driver.area("VIEW_3D").tag_redraw()
    yield 1.0


def dialog(driver: Driver, verb: str, picture: str):
    """Open an operator's dialog in the middle of the viewport, photograph it and leave it."""
    viewport = driver.area("VIEW_3D")
    x, y = viewport.x + viewport.width // 2, viewport.y + viewport.height // 2
    driver.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    with bpy.context.temp_override(
        window=driver.window, area=viewport, region=driver.region("VIEW_3D", "UI")
    ):
        getattr(bpy.ops.rtb, verb)("INVOKE_DEFAULT")
    yield 0.6
    driver.photograph(picture)
    yield from driver.press("ESC", "VIEW_3D")
    yield 0.3


def menu(driver: Driver, name: str, picture: str):
    """Open a menu in the middle of the viewport, photograph it and leave it."""
    viewport = driver.area("VIEW_3D")
    x, y = viewport.x + viewport.width // 2, viewport.y + viewport.height // 2
    driver.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    with bpy.context.temp_override(
        window=driver.window, area=viewport, region=driver.region("VIEW_3D", "UI")
    ):
        bpy.ops.wm.call_menu(name=name)
    yield 0.6
    driver.photograph(picture)
    yield from driver.press("ESC", "VIEW_3D")
    yield 0.3


def scroll_many_rows(driver: Driver):
    """Fill a thousand rows of seven variables, and measure what it costs to draw and to scroll them."""
    begin = time.perf_counter()
    ranges = "; ".join(f"v{number} = 0 1" for number in range(7))
    bpy.context.scene.rtb.set_conditions([], [])
    bpy.ops.rtb.fill_random(ranges=ranges, count=MANY)
    driver.report["filling"] = time.perf_counter() - begin
    region = driver.region("VIEW_3D", "UI")
    panel = measured(extension("panels.conditions").RTB_PT_conditions, "draw")
    item = extension("panels.conditions").RTB_UL_conditions
    items = measured(item, "draw_item")
    for number in range(0, MANY, 25):  # the list shows the active row
        bpy.context.scene.rtb.active_condition = number
        region.tag_redraw()
        yield 0.05
    driver.report["many"] = {
        "draws": len(panel),
        "panel": max(panel),
        "items": len(items),
        "item": max(items),
    }
    driver.report["a draw"] = (sum(panel) + sum(items)) / len(panel)
    driver.photograph("conditions-many")


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(looks(driver, home))
