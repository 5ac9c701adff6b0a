"""Run in a real window: the table of conditions and the menu of spectra, by mouse and keys, photographed."""

import sys
import time
from functools import partial
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import extension, make_recipe, measured

MANY = 1000


def looks(driver: Driver, folder: Path):
    """Look at spectra and at the table: none, six rows, dialogs, a thousand rows."""
    yield from driver.open_sidebar("RenderToolbox")
    driver.photograph("conditions-none")
    yield from vary_by_click(driver)
    make_recipe(folder, 6, "tracer", samples=8, size=(80, 60))
    bpy.ops.rtb.add_variable(name="gloss", value="0.1")
    bpy.context.scene.rtb.active_variable = 0
    yield 0.6
    driver.photograph("conditions")
    yield from look_at_spectra(driver)
    yield from dialog(driver, bpy.ops.rtb.fill_from_library, "conditions-library")
    yield from dialog(driver, bpy.ops.rtb.fill_random, "conditions-random")
    yield from dialog(driver, partial(bpy.ops.wm.call_menu, name="RTB_MT_conditions"), "conditions-menu")
    yield from dialog(driver, partial(bpy.ops.wm.call_menu, name="RTB_MT_spectrum"), "spectrum-menu")
    yield from dialog(driver, partial(bpy.ops.wm.call_menu, name="RTB_MT_variable"), "conditions-variable")
    yield from dialog(driver, bpy.ops.rtb.fill_pairs, "conditions-pairs")
    yield from small_pictures(driver)
    yield from scroll_many_rows(driver)
    yield from read_in_steps(driver)


def look_at_spectra(driver: Driver):
    """Photograph the curves of a material, of a lamp, and of what is no spectrum."""
    for tab, thing, picture in (
        ("MATERIAL", "Cube", "spectrum-material"),
        ("DATA", "Light", "spectrum-light"),
    ):
        bpy.context.view_layer.objects.active = bpy.data.objects[thing]
        driver.area("PROPERTIES").spaces.active.context = tab
        yield 1.2
        driver.photograph(picture)
    bpy.data.lights["Light"].rtb.spectrum = "D64"
    yield 0.8
    driver.photograph("spectrum-wrong")
    bpy.data.lights["Light"].rtb.spectrum = "D65"


def vary_by_click(driver: Driver):
    """Right-click the reflectance of the cube, choose Vary in Recipe, then choose a blue from the library."""
    material = bpy.data.materials["Material"]
    material.rtb.use_spectra, material.rtb.reflectance = True, "0.5"
    driver.area("PROPERTIES").spaces.active.context = "MATERIAL"
    yield 1.0
    panel = driver.region("PROPERTIES", "WINDOW")
    with bpy.context.temp_override(window=driver.window, area=driver.area("PROPERTIES"), region=panel):
        bpy.ops.rtb.use_library_spectrum("INVOKE_DEFAULT", field="REFLECTANCE")
    yield 0.5
    for letter in "yellow gr":
        key = "SPACE" if letter == " " else letter.upper()
        driver.window.event_simulate(type=key, value="PRESS", unicode=letter, x=panel.x + 90, y=panel.y + 200)
        yield 0.1
        driver.window.event_simulate(type=key, value="RELEASE", x=panel.x + 90, y=panel.y + 200)
    yield 0.4
    driver.photograph("spectrum-search")
    for value in ("PRESS", "RELEASE"):
        driver.window.event_simulate(type="RET", value=value, x=panel.x + 90, y=panel.y + 200)
        yield 0.3
    driver.report["searched"] = material.rtb.reflectance
    yield from driver.find("rtb.reflectance", "PROPERTIES", "WINDOW", down=262)
    yield from driver.choose_last_entry(driver.x, driver.y, "vary-menu")
    yield 0.8
    driver.photograph("varied")
    settings = bpy.context.scene.rtb
    cells = [cell.value for row in settings.conditions for cell in row.cells]
    driver.report["varied"] = [material.rtb.reflectance, [each.name for each in settings.variables], cells]


def dialog(driver: Driver, verb, picture: str):
    """Open a dialog or a menu in the middle of the viewport, photograph it and leave it."""
    viewport = driver.area("VIEW_3D")
    x, y = viewport.x + viewport.width // 2, viewport.y + viewport.height // 2
    driver.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    with bpy.context.temp_override(
        window=driver.window, area=viewport, region=driver.region("VIEW_3D", "UI")
    ):
        verb("INVOKE_DEFAULT")
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
    states, scene = extension("operators.row_states"), bpy.context.scene
    states.begin(scene)
    for number, row in enumerate(scene.rtb.conditions):
        states.take(states.row_name(scene, row, number), "done")
    panel.clear()
    items.clear()
    for number in range(0, MANY, 50):
        scene.rtb.active_condition = number
        region.tag_redraw()
        yield 0.05
    driver.report["a draw with states"] = (sum(panel) + sum(items)) / len(panel)


def small_pictures(driver: Driver):
    """Render six rows, look at their small pictures, change a cell, move the cube."""
    running, shown = extension("operators.running"), extension("operators.thumbnails")
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.render_recipe()
    while running.batch is not None:
        yield 0.1
    for _ in range(50):
        yield 0.1
        if sum(pair[0] > 0 for pair in shown._icons.values()) == 6:
            break
    scene = bpy.context.scene
    scene.rtb.conditions[1].cells[0].value = "D50"
    yield from driver.scroll("VIEW_3D", "UI", 20)
    driver.photograph("conditions-pictures")
    driver.report["pictures"] = [pair[0] > 0 for pair in shown._icons.values()]
    driver.report["states"] = [states_of(scene)]
    bpy.data.objects["Cube"].location[0] = 0.1
    yield 0.4
    driver.report["states"].append(states_of(scene))
    driver.photograph("conditions-unchecked")
    bpy.data.objects["Cube"].location[0] = 0.0
    yield from driver.scroll("VIEW_3D", "UI", -60)


def states_of(scene) -> list[str]:
    states = extension("operators.row_states")
    return [states.state(scene, row, number) for number, row in enumerate(scene.rtb.conditions)]


def read_in_steps(driver: Driver):
    """Press Render Recipe with many rows that set a property: keys change nothing, Esc leaves it."""
    scene, reading = bpy.context.scene, extension("operators.reading")
    scene.rtb.set_conditions([], [])
    bpy.ops.rtb.vary_property(home="objects", thing="Light", path="location", index=2, variable="height")
    bpy.ops.rtb.fill_range(variable="height", first=3, last=9, count=400)
    height = bpy.data.objects["Light"].location[2]
    yield 0.5
    turns = measured(reading.Reading, "turn")
    yield from driver.find("rtb.render_recipe", "VIEW_3D", "UI", down=112)
    yield from driver.click(driver.x, driver.y)
    while reading.now is None or not reading.now.share:
        yield 0.1
    yield 0.5
    driver.photograph("conditions-reading")
    share = reading.now.share
    yield from driver.press("X", "VIEW_3D")
    yield from driver.press("ESC", "VIEW_3D")
    yield 0.5
    driver.report["reading"] = {
        "share": share,
        "left": reading.now is None and extension("operators.running").batch is None,
        "height": bpy.data.objects["Light"].location[2] - height,
        "objects": len(bpy.data.objects),
        "turn": sorted(turns)[len(turns) // 2],
    }


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(looks(driver, home))
