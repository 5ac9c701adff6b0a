"""Run in a real window: any property varies, is previewed, checked, listed and rendered, photographed."""

import shutil
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import EXTENSION, extension, make_recipe

LAMP = "Light"


def workflow(driver: Driver, folder: Path):
    """Vary a location by a right click, preview rows, check, select a culprit, render one row."""
    yield from render_unsaved(driver)
    make_recipe(folder, 3, "tracer", samples=32, size=(64, 48))
    yield from search(driver)
    yield from look_at_preferences(driver)
    yield from driver.open_sidebar("Item")
    yield from vary_by_click(driver)
    yield from driver.open_sidebar("RenderToolbox")
    yield from preview_rows(driver)
    yield from look_at_mappings(driver)
    yield from check(driver)
    yield from render(driver)


def render_unsaved(driver: Driver):
    """Press Render Recipe in a file that has no place yet, and leave the question where to save it."""
    yield from driver.open_sidebar("RenderToolbox")
    yield from driver.find("rtb.render_recipe", "VIEW_3D", "UI", down=112)
    yield from driver.click(driver.x, driver.y)
    yield 1.0
    driver.photograph("workflow-unsaved")
    driver.report["asked to save"] = driver.area("FILE_BROWSER") is not None
    yield from driver.key("ESC")
    yield 0.7


def search(driver: Driver):
    """Find Check by its name, as any command of Blender's, and let it run."""
    area = driver.area("VIEW_3D")
    yield from driver.move(area.x + area.width / 3, area.y + area.height / 2)
    yield from driver.key("F3")
    yield 0.4
    yield from driver.type("recipe")
    yield 0.6
    driver.photograph("workflow-search")
    for _ in range(len("recipe")):
        yield from driver.key("BACK_SPACE")
    yield from driver.type("check")
    yield 0.6
    yield from driver.key("RET")
    yield from until_checked(driver)
    driver.report["checked by name"] = list(extension("operators.findings").remarks)


def look_at_preferences(driver: Driver):
    """Photograph the extension's preferences, once their Test has found the renderers."""
    area, manager = driver.area("VIEW_3D"), bpy.context.window_manager
    area.type, bpy.context.preferences.active_section = "PREFERENCES", "ADDONS"
    manager.addon_search = "RenderToolbox"
    yield 0.6
    bpy.ops.preferences.addon_expand(module=EXTENSION)
    area.tag_redraw()
    yield 0.6
    yield from driver.find("rtb.test_renderers", "PREFERENCES", "WINDOW", down=437)
    yield from driver.click(driver.x, driver.y)
    found = extension("operators.renderers_found").found
    yield from driver.until(lambda: found)
    yield 0.5
    driver.photograph("preferences")
    driver.report["renderers"] = {name: each.version is not None for name, each in found.items()}
    area.type = "VIEW_3D"
    yield 0.6


def vary_by_click(driver: Driver):
    """Right-click the third component of the lamp's location, and choose Vary in Recipe."""
    bpy.context.view_layer.objects.active = bpy.data.objects[LAMP]
    bpy.data.objects[LAMP].select_set(True)
    yield 0.8
    driver.photograph("workflow-item")
    region = driver.region("VIEW_3D", "UI")
    # Location X, Y, Z stand at the top of the tab, each a button high.
    x, y = region.x + region.width // 2, region.y + region.height - 103
    yield from driver.choose_last_entry(x, y, "workflow-vary")
    yield 0.8
    settings = bpy.context.scene.rtb
    driver.report["varied"] = [[each.name, each.value] for each in settings.mappings]
    driver.report["variables"] = [[each.name, each.kind] for each in settings.variables]


def preview_rows(driver: Driver):
    """Show one row after the other in the viewport."""
    settings = bpy.context.scene.rtb
    for number, row in enumerate(settings.conditions):
        row.cells[1].value = str(3 + number)
    bpy.ops.rtb.preview_condition(show=True)
    driver.report["heights"] = []
    for number in range(3):
        settings.active_condition = number
        yield 0.4
        driver.report["heights"].append(bpy.data.objects[LAMP].location[2])
    driver.photograph("workflow-preview")
    yield from take_back(driver)
    bpy.ops.rtb.preview_condition(show=False)
    driver.report["height afterwards"] = bpy.data.objects[LAMP].location[2]


def take_back(driver: Driver):
    """Save, undo and redo while a condition is shown: it never gets into the file, and comes back."""
    lamp, shown = bpy.data.objects[LAMP], bpy.data.objects[LAMP].location[2]
    bpy.ops.wm.save_mainfile()
    copy = str(Path(bpy.data.filepath).with_name("copy.blend"))
    shutil.copy(bpy.data.filepath, copy)
    with bpy.data.libraries.load(copy) as (_, wanted):
        wanted.objects = [LAMP]
    driver.report["height saved"] = wanted.objects[0].location[2]
    bpy.data.objects.remove(wanted.objects[0])
    driver.report["heights shown again"] = [lamp.location[2] - shown]
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.ed.undo_push(message="Before")
        bpy.data.objects["Cube"].location[0] = 1
        bpy.ops.ed.undo_push(message="Moved")
        for verb in (bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.undo):
            verb()
            yield 0.3
            driver.report["heights shown again"].append(bpy.data.objects[LAMP].location[2] - shown)
    driver.report["cube"] = bpy.data.objects["Cube"].location[0]


def look_at_mappings(driver: Driver):
    """Photograph the list of mappings: a good one, a broken one, a written one, and the text."""
    settings = bpy.context.scene.rtb
    bpy.ops.rtb.vary_property(home="cameras", thing="Camera", path="lens", index=-1, variable="lens")
    settings.mappings[1].value = "2 * (lens)"
    bpy.ops.rtb.vary_property(home="objects", thing="Cube", path="scale", index=0, variable="width")
    settings.mappings[2].value = "(breadth)"
    yield from driver.scroll("VIEW_3D", "UI", 40)
    driver.photograph("workflow-mappings")
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.edit_mappings_text()
    text = settings.mappings_text
    blocks = {"Mitsuba": "integrator:maxDepth.integer = 3", "Generic": "Glass-material:intIOR.float = 1.6"}
    text.from_string("".join(f"{kind} {{\n    {line}\n}}\n" for kind, line in blocks.items()))
    yield 1.0
    yield from driver.scroll("VIEW_3D", "UI", 40)
    driver.photograph("workflow-text")
    bpy.data.texts.remove(text)
    driver.area("TEXT_EDITOR").type = "VIEW_3D"
    yield from driver.scroll("VIEW_3D", "UI", -60)


def check(driver: Driver):
    """Check a recipe with several faults, select one culprit by a click, mend them and check again."""
    settings = bpy.context.scene.rtb
    settings.conditions[1].cells[0].value = "BabelColor Average/gren"
    bpy.data.lights["Light"].rtb.spectrum = "D64"
    yield from checked(driver)
    yield 1.5  # panels below one that grows slide a moment later
    driver.photograph("workflow-check")
    driver.report["errors"] = list(extension("operators.findings").errors)
    culprits = extension("operators.findings").culprits
    driver.report["culprits"] = {sentence: list(each) for sentence, each in culprits.items()}
    bpy.context.view_layer.objects.active = bpy.data.objects["Cube"]
    light = next(each for each in culprits.values() if each.kind == "light")
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.select_culprit(kind=light.kind.upper(), name=light.name)
    driver.report["selected"] = bpy.context.view_layer.objects.active.name
    settings.conditions[1].cells[0].value = "BabelColor Average/green"
    bpy.data.lights["Light"].rtb.spectrum = "D65"
    settings.mappings[2].value = "(width)"
    yield from checked(driver)
    driver.photograph("workflow-checked")
    driver.report["mended"] = list(extension("operators.findings").errors)


def checked(driver: Driver):
    """Check, and wait for what the child says."""
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.check_recipe()
    yield from until_checked(driver)


def until_checked(driver: Driver):
    """Wait for what a check that was begun says."""
    yield 0.3
    while extension("operators.child_verb").under_way or extension("operators.reading").now is not None:
        yield 0.1
    yield 0.6


def render_typed(driver: Driver, folder: Path):
    """Render the same condition by the command line and from a script, in folders of their own."""
    typed, scripted = folder.with_name("typed"), folder.with_name("scripted")
    shutil.copytree(folder, typed, ignore=shutil.ignore_patterns("renderings", "images", "scenes"))
    child = extension("rtb_addon.background").start_child(["render", str(typed), "--conditions", "green"])
    extension("rtb_addon.blender").read_recipe(bpy.context.scene).save(scripted)
    yield from driver.until(lambda: child.poll() is not None)
    child.communicate()
    batch = extension("operators.child_batch").ChildBatch(scripted, ["green"])
    yield from driver.until(lambda: batch.take() and batch.ended)
    driver.report["cubes"] = [str(each / "renderings/tracer/green.exr") for each in (folder, typed, scripted)]


def render(driver: Driver):
    """Render the active condition alone, then all of them, photographed in the middle."""
    settings, running = bpy.context.scene.rtb, extension("operators.running")
    settings.active_condition = 1
    yield from driver.find("rtb.render_condition", "VIEW_3D", "UI", down=143, across=0.25)
    yield from driver.click(driver.x, driver.y)
    yield from driver.until(lambda: running.batch is not None)
    yield from driver.until(lambda: running.batch is None)
    folder = Path(bpy.path.abspath("//rtb/cube"))
    cubes = folder / "renderings/tracer"
    driver.report["rendered alone"] = sorted(each.stem for each in cubes.glob("*.exr"))
    yield from render_typed(driver, folder)
    settings.samples = 2000
    with bpy.context.temp_override(window=driver.window):
        bpy.ops.rtb.render_recipe()
    while running.batch is not None and not running.batch.under_way:
        yield 0.1
    yield 0.5
    driver.photograph("workflow-rendering")
    driver.report["under way"] = dict(running.batch.under_way) if running.batch is not None else {}
    running.stop()
    yield 0.3


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"  # a window of its own has no photograph
    driver = Driver(report_file, pictures)
    driver.run(workflow(driver, home))
