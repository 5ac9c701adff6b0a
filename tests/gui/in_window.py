"""Run in a real window: an experiment by mouse and keys, photographed, with batches stopped in every way."""

import os
import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver, Pulse
from scene import EXTENSION, extension, make_recipe, measured

HEAVY = {"mitsuba", "drjit", "colour", "scipy", "OpenEXR", "embreex"}
LONG = 200_000  # paths per pixel that nobody waits for


def experiment(driver: Driver, folder: Path):
    """Look at the panels, render by a click, look at the montage, then stop batches in every way."""
    yield from look_at_untagged_panels(driver)
    make_recipe(folder, 6, "tracer", samples=8, size=(80, 60))
    yield from look_at_tagged_panels(driver)
    yield from driver.open_sidebar("RenderToolbox")
    driver.photograph("recipe")
    yield from open_image_editor(driver)
    yield from render_by_click(driver)
    yield from stop_by_key_and_button(driver)
    yield from show_errors(driver)
    yield from disturb_batches(driver, folder)
    yield from quit_while_rendering(driver)


def look_at_untagged_panels(driver: Driver):
    """Photograph what a newcomer sees, and press Use Spectra."""
    yield from properties(driver, "MATERIAL", "Cube")
    driver.photograph("material-untagged")
    yield from press_button(driver, "PROPERTIES", "WINDOW", index=0)
    material = bpy.data.materials["Material"]
    driver.report["use spectra pressed"] = [material.rtb.use_spectra, material.rtb.reflectance]


def look_at_tagged_panels(driver: Driver):
    """Photograph the properties of a material, a light and the world."""
    for tab, thing in (("MATERIAL", "Cube"), ("DATA", "Light"), ("WORLD", "Cube")):
        yield from properties(driver, tab, thing)
        driver.photograph({"MATERIAL": "material", "DATA": "light", "WORLD": "world"}[tab])


def properties(driver: Driver, tab: str, thing: str):
    """Show a tab of the properties of an object."""
    bpy.context.view_layer.objects.active = bpy.data.objects[thing]
    driver.area("PROPERTIES").spaces.active.context = tab
    yield 0.6


def open_image_editor(driver: Driver):
    """Split the viewport, as somebody has done who wants to see pictures."""
    viewport = driver.area("VIEW_3D")
    with bpy.context.temp_override(window=driver.window, area=viewport):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.4)
    smallest = min((a for a in driver.window.screen.areas if a.type == "VIEW_3D"), key=lambda a: a.width)
    smallest.type = "IMAGE_EDITOR"
    yield 1.5


def render_by_click(driver: Driver):
    """Click Render Recipe, and measure how Blender lives through the batch."""
    running = extension("operators.running")
    drawing = Pulse()
    for _ in range(10):  # what it costs here to draw the window, batch or not
        for area in driver.window.screen.areas:
            area.tag_redraw()
        yield 0.2
    driver.report["drawing"] = drawing.stop()
    spent = (
        measured(extension("operators.child_batch").ChildBatch, "take"),
        measured(extension("panels.recipe").RTB_PT_recipe, "draw"),
    )
    yield from press_button(driver, "VIEW_3D", "UI", index=0)
    driver.report["started by click"] = running.batch is not None
    pulse = Pulse()
    driver.report["child"] = running.batch._child.pid != os.getpid()
    while running.batch is not None:
        yield 0.05
    driver.report["rendering"] = pulse.stop()
    driver.report["longest of ours"] = {"take": max(spent[0]), "draw": max(spent[1])}
    driver.report["errors after rendering"] = list(extension("operators.findings").errors)
    yield 1.5
    driver.photograph("montage")
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    driver.report["montage"] = [image.name, list(image.size)] if image else None
    driver.report["heavy modules"] = sorted(HEAVY & set(sys.modules))


def stop_by_key_and_button(driver: Driver):
    """Stop batches with Esc over each editor and with the button in the panel."""
    bpy.context.scene.rtb.samples = 400
    yield from start(driver)
    while extension("operators.running").batch.finished < 2:
        yield 0.05
    yield 0.3
    driver.photograph("rendering")
    yield from driver.press("ESC", "VIEW_3D")
    yield from until_stopped(driver, "Esc over VIEW_3D")
    bpy.context.scene.rtb.samples = LONG
    yield from start(driver)
    yield from driver.press("ESC", "IMAGE_EDITOR")
    yield from until_stopped(driver, "Esc over IMAGE_EDITOR")
    yield from start(driver)
    region = driver.region("VIEW_3D", "UI")
    # Left of their icons, the buttons at the right border: that of the folder, and at the bar's end Cancel.
    _, cancel, *_ = driver.button_rows(driver.photograph("before-cancel"), region, from_left=0.802)
    yield from driver.click(region.x + 0.83 * region.width, sum(cancel) / 2)
    yield from until_stopped(driver, "Cancel button")


def start(driver: Driver):
    """Start a batch and wait until it is at work."""
    begin = time.perf_counter()
    bpy.ops.rtb.render_recipe()
    driver.report["export and start"] = time.perf_counter() - begin
    batch = extension("operators.running").batch
    while not batch.total and not batch.ended:
        yield 0.05
    yield 1.0


def until_stopped(driver: Driver, how: str):
    """Note how long a batch takes to stop [s], and how many processes are left."""
    running, begin = extension("operators.running"), time.perf_counter()
    while running.batch is not None and time.perf_counter() - begin < 5:
        yield 0.02
    driver.report.setdefault("stopped", {})[how] = time.perf_counter() - begin
    yield 0.5
    # The process that looks at renderings goes on, for whoever looks at those that are there.
    driver.report.setdefault("left", {})[how] = children(but=b"rtb_addon.viewer")


def show_errors(driver: Driver):
    """Photograph how the panel says what is wrong."""
    camera = bpy.context.scene.camera
    bpy.context.scene.camera = None
    bpy.data.objects["Light"].hide_render = True
    try:
        bpy.ops.rtb.render_recipe()
    except RuntimeError as error:
        driver.report["refused"] = str(error).strip()
    yield 0.8
    driver.photograph("error")
    bpy.context.scene.camera = camera
    bpy.data.objects["Light"].hide_render = False


def disturb_batches(driver: Driver, folder: Path):
    """Undo, open a file and disable the extension in the middle of a batch."""
    import addon_utils

    cubes = {file: file.stat().st_mtime_ns for file in folder.rglob("*.exr")}
    bpy.ops.ed.undo_push(message="Something")
    yield from start(driver)
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.ed.undo()
    yield 0.5
    batch = extension("operators.running").batch
    driver.report["undo leaves the batch alone"] = batch is not None and batch._child.poll() is None
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    driver.report.setdefault("left", {})["opening a file"] = children()
    yield from show_montage_beside(driver)
    bpy.context.scene.rtb.samples = LONG
    yield from start(driver)
    bpy.ops.rtb.test_renderers()  # one more child, which would answer to nobody
    addon_utils.disable(EXTENSION)
    driver.report["left"]["disabling"] = children()
    addon_utils.enable(EXTENSION)
    yield 0.5
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.export_recipe("INVOKE_DEFAULT")
    reading = extension("operators.reading")
    driver.report["read while disabling"] = [reading.now is not None]
    addon_utils.disable(EXTENSION)
    driver.report["read while disabling"].append(reading.now is not None)
    addon_utils.enable(EXTENSION)
    yield 0.5
    driver.report["cubes kept"] = [len(cubes), all(f.stat().st_mtime_ns == when for f, when in cubes.items())]


def show_montage_beside(driver: Driver):
    """Show the montage where no Image Editor is open."""
    yield 1.0
    before = driver.area("IMAGE_EDITOR")
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.show_montage()
    yield from driver.until(lambda: (area := driver.area("IMAGE_EDITOR")) and area.spaces.active.image)
    yield 1.0
    driver.photograph("montage-beside")
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    driver.report["montage beside"] = [before is None, image.name]


def quit_while_rendering(driver: Driver):
    """Leave Blender while a batch is at work."""
    yield from start(driver)
    driver.report["when quitting"] = children()
    driver.write()
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.wm.quit_blender()


def press_button(driver: Driver, area_kind: str, region_kind: str, index: int):
    """Click the button of that number, from the top, in a region."""
    region = driver.region(area_kind, region_kind)
    rows = driver.button_rows(driver.photograph("pressing"), region, from_left=0.3)
    yield from driver.click(region.x + region.width / 2, sum(rows[index]) / 2)
    yield 0.5


def children(but: bytes = b"nothing") -> list[int]:
    """Return the processes of the extension that this Blender has started, in any depth, and still has."""
    mark = f"BLENDER_USER_RESOURCES={os.environ['BLENDER_USER_RESOURCES']}".encode()
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command, environment = (folder / "cmdline").read_bytes(), (folder / "environ").read_bytes()
        except OSError:
            continue
        if b"rtb_addon" in command and but not in command and mark in environment.split(b"\0"):
            found.append(int(folder.name))
    return found


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(experiment(driver, home))
