"""Run in a real window: a montage that fills, ways to look at renderings, and the spectrum probe."""

import sys
import time
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import extension, make_recipe

HEAVY = {"mitsuba", "drjit", "colour", "scipy", "OpenEXR", "embreex", "PIL"}
TOOL = "rtb.probe_tool"


def looking(driver: Driver, folder: Path):
    """Render with no Image Editor open, then look at what came of it in every way."""
    make_recipe(folder, 6, "tracer", samples=200, size=(160, 120))
    bpy.context.scene.rtb.layers = {"standard_error"}
    bpy.ops.ed.undo_push(message="before")
    bpy.data.objects["Cube"].location.z = 0.01
    bpy.ops.ed.undo_push(message="moved")
    yield 0.5
    yield from watch_montage_fill(driver)
    yield from undo_beside(driver)
    yield from open_sidebar(driver)
    yield from slide(driver)
    yield from look_in_every_way(driver)
    yield from probe_by_hand(driver)
    yield from copy_by_hand(driver, folder)
    driver.report["heavy modules"] = sorted(HEAVY & set(sys.modules))


def watch_montage_fill(driver: Driver):
    """Start a batch and note what the Image Editor shows while it runs."""
    running, viewing = extension("operators.running"), extension("operators.viewing")
    spent = [timed(running, "_look"), timed(viewing, "_arrived"), timed(viewing, "_take")]
    driver.report["image editors before"] = driver.area("IMAGE_EDITOR") is not None
    bpy.ops.rtb.render_recipe()
    filled = []
    while running.batch is not None:
        shown = len(viewing.seen["there"]) if viewing.seen else 0
        if shown and (not filled or filled[-1] != shown):
            filled.append(shown)
            if len(filled) == 2:
                yield 0.3
                driver.photograph("montage-filling")
        yield 0.02
    yield 1.5
    driver.report["filled"] = [*filled, len(viewing.seen["there"])]
    driver.report["longest"] = {name: max(times) for name, times in spent}
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    driver.report["shown"] = [image.name, list(image.size), image.is_dirty]
    driver.report["errors"] = list(extension("operators.findings").errors)


def timed(module, name: str):
    """Let a function of a module note how long it takes [s], as processor time of this thread."""
    notes, function = [], getattr(module, name)

    def note(*arguments):
        begin = time.thread_time()
        try:
            return function(*arguments)
        finally:
            notes.append(time.thread_time() - begin)

    setattr(module, name, note)
    return name, notes


def open_sidebar(driver: Driver):
    """Give the Image Editor most of the window, and show our tab in its sidebar."""
    area = driver.area("IMAGE_EDITOR")
    area.spaces.active.show_region_ui = True
    area.spaces.active.show_region_toolbar = True
    yield 1.0
    driver.region("IMAGE_EDITOR", "UI").active_panel_category = "RenderToolbox"
    area.tag_redraw()
    yield 1.0
    fit(driver)
    yield 0.8
    driver.photograph("rendering-panel")


def undo_beside(driver: Driver):
    """Undo, by its keys, what was done before the batch began, while the montage is shown."""
    area = driver.area("VIEW_3D")
    yield from driver.move(area.x + area.width // 2, area.y + area.height // 2)
    for value in ("PRESS", "RELEASE"):
        driver.window.event_simulate(type="Z", value=value, x=driver.x, y=driver.y, ctrl=True)
        yield 0.3
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    moved = bpy.data.objects["Cube"].location.z
    driver.report["after undo"] = [moved, None if image is None else [image.name, list(image.size)]]


def slide(driver: Driver):
    """Choose the view of one band and drag its slider."""
    view, viewing = bpy.context.window_manager.rtb_view, extension("operators.viewing")
    view.kind = "wavelength"
    yield from answered(viewing)
    yield from driver.find("rtb_view.wavelength", "IMAGE_EDITOR", "UI", down=100)
    before = [view.wavelength, mean_colour(driver)]
    yield from driver.drag((driver.x, driver.y), (driver.x + 40, driver.y))
    yield from answered(viewing)
    driver.report["slid"] = [before, [view.wavelength, mean_colour(driver)]]
    view.wavelength = 550.0
    yield from answered(viewing)


def fit(driver: Driver) -> None:
    """Show the whole picture."""
    region = driver.region("IMAGE_EDITOR", "WINDOW")
    with bpy.context.temp_override(window=driver.window, area=driver.area("IMAGE_EDITOR"), region=region):
        bpy.ops.image.view_all(fit_view=True)


def look_in_every_way(driver: Driver):
    """Photograph each view, and note what it shows."""
    view, viewing = bpy.context.window_manager.rtb_view, extension("operators.viewing")
    found = driver.report.setdefault("views", {})
    for kind in ("wavelength", "luminance", "difference", "error"):
        if kind == "difference":
            view.other = "red"
        view.kind = kind
        yield from answered(viewing)
        found[kind] = [viewing.sentence, viewing.seen["full"], mean_colour(driver)]
        driver.photograph(f"view-{kind}")
    view.kind = "difference"
    yield from answered(viewing)
    view.auto_scale = False
    found["scale taken over"] = [view.full_radiance, viewing.seen["full"]]
    view.kind, view.condition, view.auto_scale = "srgb", "blue", True
    yield from answered(viewing)
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    found["blue"] = [viewing.sentence, list(image.size), mean_colour(driver)]
    view.condition = "nobody"
    yield from answered(viewing)
    found["nobody"] = viewing.sentence
    view.condition = ""
    yield from answered(viewing)
    fit(driver)
    yield 0.5
    yield from hide_names(driver)


def hide_names(driver: Driver):
    """Look for a name at the lower left corner of its tile, then hide what lies over the picture."""
    overlay, found = driver.area("IMAGE_EDITOR").spaces.active.overlay, []
    x, y = (int(each) for each in place(driver, "green", 0.0, 1.0))
    for shown in (True, False):
        overlay.show_overlays = shown
        yield 0.5
        picture = driver.photograph("names")[y + 2 : y + 18, x + 2 : x + 42]
        found.append(int((picture.min(axis=2) > 180).sum()))
    overlay.show_overlays = True
    driver.report["bright pixels of a name"] = found


def answered(viewing):
    """Wait until the viewer has answered and the picture is drawn."""
    deadline = time.monotonic() + 20
    while viewing._child.busy and time.monotonic() < deadline:
        yield 0.02
    yield 0.6


def mean_colour(driver: Driver) -> list[float]:
    """Return the mean red, green and blue of the picture that is shown."""
    image = driver.area("IMAGE_EDITOR").spaces.active.image
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(-1, 4)[:, :3].mean(axis=0).tolist()


def probe_by_hand(driver: Driver):
    """Choose the tool, point, drag, and drag with Shift."""
    yield from driver.find(TOOL, "IMAGE_EDITOR", "TOOLS", down=100, across=0.5)
    yield from driver.click(driver.x, driver.y)
    driver.report["tool"] = bpy.context.workspace.tools.from_space_image_mode("VIEW").idname
    space = driver.area("IMAGE_EDITOR").spaces.active
    space.show_region_ui = False  # it covers half of the renderings
    yield 0.5
    pins = extension("operators.pins")
    yield from driver.move(*place(driver, "blue", 0.5, 0.5))
    yield 1.0
    driver.photograph("probe-hovering")
    driver.report["hovered"] = [pins.hovered.condition, list(pins.hovered.region), pins.hovered.luminance]
    yield from driver.drag(place(driver, "blue", 0.42, 0.42), place(driver, "blue", 0.55, 0.6))
    yield 1.0
    driver.photograph("probe-box")
    yield from driver.drag(place(driver, "red", 0.42, 0.42), place(driver, "red", 0.55, 0.6), shift=True)
    yield 1.0
    yield from driver.move(*place(driver, "cyan", 0.9, 0.9))
    yield 1.0
    driver.photograph("probe")
    space.show_region_ui = True
    yield 0.8
    driver.photograph("probe-panel")
    window_manager = bpy.context.window_manager
    driver.report["pins"] = [[pin.name, pin.number, pin.first] for pin in window_manager.rtb_pins]
    found = pins.difference_of(*(pin.words for pin in window_manager.rtb_pins))
    driver.report["difference"] = [found.delta_e, list(found.cone_contrast)]
    area = driver.region("IMAGE_EDITOR", "WINDOW")
    yield from driver.move(area.x + 5, area.y + 5)
    yield 0.5
    driver.report["off the picture"] = pins.hovered is None


def place(driver: Driver, condition: str, across: float, down: float) -> tuple[float, float]:
    """Return where in the window a part of a condition's tile is shown."""
    viewing = extension("operators.viewing")
    tiles, region = viewing.tiles(), driver.region("IMAGE_EDITOR", "WINDOW")
    left, top = tiles.corner(tiles.names.index(condition))
    x, y = left + across * tiles.tile[0], top + down * tiles.tile[1]
    seen = region.view2d.view_to_region(x / tiles.size[0], 1 - y / tiles.size[1], clip=False)
    return region.x + seen[0], region.y + seen[1]


def copy_by_hand(driver: Driver, folder: Path):
    """Copy the pins by their button, and write them to a file."""
    yield from driver.find("rtb.copy_pins", "IMAGE_EDITOR", "UI", down=330, across=0.4)
    bpy.context.window_manager.clipboard = ""
    yield from driver.click(driver.x, driver.y)
    yield 0.3
    driver.report["clipboard"] = bpy.context.window_manager.clipboard
    bpy.ops.rtb.export_pins(filepath=str(folder / "pins.csv"))
    driver.report["file"] = (folder / "pins.csv").read_text()
    driver.report["cubes"] = str(folder / "rtb/cube/renderings/tracer")


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(looking(driver, home))
