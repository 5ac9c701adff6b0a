"""Run in a real window: spectral materials, lamps and worlds in their panels, photographed."""

import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import extension, measured

POINT = -271, -127  # the curve's at 455 nm, from where the pointer was when its dialog was opened [pixels]
HEADERS = (335, 314)  # of the sub-panels of a blend, from the top [pixels]


def looks(driver: Driver, folder: Path):
    """Look at each kind of panel in a Properties editor as wide as Blender makes it, and tall."""
    folder.mkdir(parents=True, exist_ok=True)
    yield from taller(driver)
    yield from materials(driver, folder)
    yield from lamps(driver)
    yield from worlds(driver, folder)
    yield from assets(driver)


def taller(driver: Driver):
    """Give the Properties editor the Outliner's room."""
    outliner, properties = driver.area("OUTLINER"), driver.area("PROPERTIES")
    outliner.type = "PROPERTIES"
    yield 0.4
    with bpy.context.temp_override(window=driver.window, area=properties):
        bpy.ops.screen.area_close()
    yield 0.6


def show(driver: Driver, tab: str, thing: str):
    """Turn the Properties editor to a tab of an object."""
    bpy.context.view_layer.objects.active = bpy.data.objects[thing]
    driver.area("PROPERTIES").spaces.active.context = tab
    yield 1.0


def materials(driver: Driver, folder: Path):
    yield from show(driver, "MATERIAL", "Cube")
    with bpy.context.temp_override(object=bpy.data.objects["Cube"]):
        bpy.ops.rtb.use_spectra(thing="MATERIAL")
    settings = bpy.data.materials["Material"].rtb
    driver.report["promoted"] = settings.model
    drawn = measured(extension("panels.spectral_material").RTB_PT_spectral_material, "draw")
    yield from driver.settled()
    driver.photograph("material-matte")
    settings.model = "metal"
    settings.eta, settings.k = "Metals/Au gold eta", "Metals/Au gold k"
    yield from driver.settled()
    driver.photograph("material-metal")
    settings.model, settings.ior = "roughglass", "Glasses/N-BK7"
    yield from driver.settled()
    driver.photograph("material-glass")
    yield from open_parts(driver)
    driver.photograph("material-renderers")
    yield from search(driver)
    yield from table(driver)
    yield from flat(driver)
    yield from curve(driver)
    driver.report["a draw"] = sorted(drawn)[len(drawn) // 2]


def open_parts(driver: Driver):
    """Click the headers of the sub-panels of a short material, the lower one first."""
    settings = bpy.data.materials["Material"].rtb
    settings.model, settings.ior = "thinglass", "Glasses/N-BK7"
    settings.model = "blend"
    yield 1.5
    region = driver.region("PROPERTIES", "WINDOW")
    for up in HEADERS:
        yield from driver.click(region.x + 60, region.y + region.height - up)
        yield 0.6
    settings.opacity, settings.detail = 0.5, "normalmap"
    driver.area("PROPERTIES").tag_redraw()
    yield 1.5


def table(driver: Driver):
    """Open the table of a spectrum's numbers."""
    bpy.data.materials["Material"].rtb.reflectance = "BabelColor Average/blue"
    region = driver.region("PROPERTIES", "WINDOW")
    with bpy.context.temp_override(window=driver.window, area=driver.area("PROPERTIES"), region=region):
        bpy.ops.rtb.use_table("INVOKE_DEFAULT", field="REFLECTANCE")
    yield 1.0
    driver.photograph("spectrum-table")
    yield from driver.press("ESC", "PROPERTIES")
    yield 0.3


def flat(driver: Driver):
    """Open the dialog of a flat spectrum, type a number where the pointer is, and use it."""
    settings, region = bpy.data.materials["Material"].rtb, driver.region("PROPERTIES", "WINDOW")
    settings.model, settings.reflectance = "matte", "0.25"
    yield from driver.move(region.x + 90, region.y + region.height // 2)
    with bpy.context.temp_override(window=driver.window, area=driver.area("PROPERTIES"), region=region):
        bpy.ops.rtb.use_flat_spectrum("INVOKE_DEFAULT", field="REFLECTANCE")
    yield 0.8
    yield from driver.click(driver.x, driver.y)
    yield 0.3
    yield from driver.type("1")
    yield from driver.key("RET")
    yield 0.5
    driver.photograph("spectrum-flat")
    yield from driver.key("RET")
    yield 0.5
    driver.report["flat"] = settings.reflectance


def curve(driver: Driver):
    """Open a spectrum as a curve, drag one of its points up, and use what was drawn."""
    settings, viewport = bpy.data.materials["Material"].rtb, driver.area("VIEW_3D")
    settings.reflectance = "BabelColor Average/blue"
    x, y = viewport.x + 500, viewport.y + 400
    yield from driver.move(x, y)
    region = driver.region("PROPERTIES", "WINDOW")
    with bpy.context.temp_override(window=driver.window, area=driver.area("PROPERTIES"), region=region):
        bpy.ops.rtb.use_curve("INVOKE_DEFAULT", field="REFLECTANCE")
    yield 0.8
    yield from driver.drag((x + POINT[0], y + POINT[1]), (x + POINT[0], y + POINT[1] + 60))
    yield 0.5
    driver.photograph("spectrum-curve")
    yield from driver.key("RET")
    yield 0.5
    driver.report["drawn"] = [settings.reflectance, len(bpy.data.node_groups)]


def search(driver: Driver):
    """Open the library's search for a reflectance, as a click in the menu does."""
    region = driver.region("PROPERTIES", "WINDOW")
    x, y = region.x + 60, region.y + region.height // 2
    driver.window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield 0.2
    begin = time.perf_counter()
    with bpy.context.temp_override(window=driver.window, area=driver.area("PROPERTIES"), region=region):
        bpy.ops.rtb.use_library_spectrum("INVOKE_DEFAULT", field="REFLECTANCE")
    driver.report["opening the library"] = time.perf_counter() - begin
    yield 1.5
    driver.photograph("library-search")
    yield from driver.press("ESC", "PROPERTIES")
    yield 0.3


def lamps(driver: Driver):
    light = bpy.data.lights["Light"]
    light.rtb.use_spectra, light.rtb.spectrum = True, "FL2"
    yield from show(driver, "DATA", "Light")
    yield from driver.settled()
    driver.photograph("light-watts")
    light.rtb.measure, light.rtb.amount = "LUX", 500
    words = extension("rtb_addon.blender.light_words")
    for _ in range(50):
        driver.area("PROPERTIES").tag_redraw()
        yield 0.2
        if words.told(light, bpy.context.scene).rows:
            break
    driver.report["told"] = words.told(light, bpy.context.scene).rows
    yield from driver.settled()
    driver.photograph("light-lux")


def worlds(driver: Driver, folder: Path):
    world = bpy.context.scene.world
    yield from show(driver, "WORLD", "Cube")
    world.rtb.use_spectra, world.rtb.spectrum = True, "daylight 5000"
    yield from driver.settled()
    driver.photograph("world-constant")
    image = bpy.data.images.new("sky", 64, 32)
    image.filepath_raw, image.file_format = str(folder / "sky.png"), "PNG"
    image.save()
    world.rtb.kind, world.rtb.image = "IMAGE", image
    yield from driver.settled()
    driver.photograph("world-image")
    world.rtb.kind = "SUNSKY"
    yield from driver.settled()
    driver.photograph("world-sky")


def assets(driver: Driver):
    """Show the Asset Browser beside the viewport, drag a material on the cube, undo that; append another."""
    libraries = bpy.context.preferences.filepaths.asset_libraries
    ours = [each for each in libraries if each.name == "RenderToolbox"]
    driver.report["asset libraries"] = [each.name for each in ours]
    with bpy.context.temp_override(window=driver.window, area=driver.area("VIEW_3D")):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield 0.5
    views = [area for area in driver.window.screen.areas if area.type == "VIEW_3D"]
    browser, viewport = sorted(views, key=lambda area: area.x)
    browser.ui_type = "ASSETS"
    yield 1.0
    browser.spaces.active.params.asset_library_reference = "RenderToolbox"
    browser.tag_redraw()
    yield 3.0
    driver.photograph("assets")
    tiles = next(region for region in browser.regions if region.type == "WINDOW")
    middle = (viewport.x + viewport.width // 2, viewport.y + viewport.height // 2)
    yield from driver.drag((tiles.x + 50, tiles.y + tiles.height - 60), middle)
    yield 1.0
    driver.photograph("assets-dragged")
    shown = bpy.data.objects["Cube"].active_material
    driver.report["dragged"] = [shown.name, shown.rtb.use_spectra, shown.rtb.reflectance]
    yield from driver.move(*middle)
    yield from driver.key("Z", ctrl=True)
    yield 0.5
    driver.report["dragged, undone"] = bpy.data.objects["Cube"].active_material.name
    file = Path(ours[0].path) / "spectral_materials.blend"
    with bpy.data.libraries.load(str(file), assets_only=True) as (there, wanted):
        driver.report["assets"] = len(there.materials)
        wanted.materials = ["gold, brushed"]
    settings = bpy.data.materials["gold, brushed"].rtb
    driver.report["appended"] = [settings.model, settings.eta]


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(looks(driver, home))
