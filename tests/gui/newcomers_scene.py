"""A newcomer's first five minutes: a material, a lamp and a table of conditions, by mouse and keys alone."""

import bpy
from driver import Driver

MATERIAL_TAB, OUTPUT_TAB = (1069, 183), (1069, 519)  # in a window of 1280 x 800, from the lower left [pixels]
CUBE, LAMP = (500, 420), (675, 643)
# Where the dialog shows two rows of the chart, and its button, from the pointer that opened it [pixels].
PATCHES = [(x, y) for y in (-175, -198) for x in (-324, -178, -30)]
FILL_IN = -66, -276
BELOW_ADD = -48  # where the menu of the table is, from the button that adds a row [pixels]
MENU = 0.93  # where the menu of a spectrum is beside its field, as a share of the panel's width


def paint(driver: Driver):
    """Let the cube's material speak in spectra, and choose one by name."""
    yield from driver.click(*MATERIAL_TAB)
    yield 0.5
    yield from driver.click_on("rtb.use_spectra", "PROPERTIES", "WINDOW", down=209)
    yield 0.7
    driver.photograph("newcomer-1-matte")
    yield from open_menu(driver, "rtb.reflectance", down=238)
    yield from take_from_library(driver, "blue", "newcomer-2-library")
    driver.photograph("newcomer-2-blue")
    material = bpy.data.materials["Material"].rtb
    driver.report["material"] = [material.model, material.reflectance]


def shine(driver: Driver):
    """Select the lamp, give it daylight and 100 W."""
    yield from driver.click(*LAMP)
    yield 0.5
    yield from driver.click_on("rtb.use_spectra", "PROPERTIES", "WINDOW", down=122)
    yield 0.5
    yield from open_menu(driver, "rtb.spectrum", down=122)
    yield from take_from_library(driver, "d65")
    yield from driver.click_on("energy", "PROPERTIES", "WINDOW", down=347)
    yield from driver.type("100")
    yield from driver.key("RET")
    yield 0.5
    driver.photograph("newcomer-3-light")
    lamp = bpy.data.lights["Light"]
    driver.report["light"] = [lamp.rtb.spectrum, lamp.energy]


def vary(driver: Driver):
    """Select the cube again, and let its reflectance vary, by a right click."""
    yield from driver.click(*CUBE)
    yield 0.5
    yield from driver.click(*MATERIAL_TAB)
    yield 0.5
    yield from driver.find("rtb.reflectance", "PROPERTIES", "WINDOW", down=261)
    yield from driver.choose_last_entry(driver.x, driver.y, "newcomer-4-vary")
    yield 1.0
    driver.photograph("newcomer-4-table")
    sidebar = driver.region("VIEW_3D", "UI")
    driver.report["table opened"] = [sidebar.width > 1, sidebar.active_panel_category]


def fill(driver: Driver):
    """Fill the table with six patches of the library."""
    yield from driver.find("rtb.add_condition", "VIEW_3D", "UI", down=276, across=0.823)
    yield from driver.click(driver.x, driver.y + BELOW_ADD)
    yield 0.5
    yield from driver.type("ff")  # Fill In, From Library…
    yield 0.5
    x, y = driver.x, driver.y
    for right, up in PATCHES:
        yield from driver.click(x + right, y + up)
    driver.photograph("newcomer-5-patches")
    yield from driver.click(x + FILL_IN[0], y + FILL_IN[1])
    yield 0.7
    driver.photograph("newcomer-5-rows")
    rows = bpy.context.scene.rtb.conditions
    driver.report["rows"] = [[row.name, *(cell.value for cell in row.cells)] for row in rows]


def preview(driver: Driver):
    """Show the active row in the viewport."""
    yield from driver.click_on("rtb_preview", "VIEW_3D", "UI", down=478)
    yield 0.7
    driver.photograph("newcomer-6-preview")
    driver.report["previewed"] = list(bpy.data.materials["Material"].diffuse_color)


def open_menu(driver: Driver, field: str, down: int):
    """Open the menu of spectra beside a field of a panel."""
    yield from driver.find(field, "PROPERTIES", "WINDOW", down)
    region = driver.region("PROPERTIES", "WINDOW")
    yield from driver.click(region.x + MENU * region.width, driver.y)
    yield 0.4


def take_from_library(driver: Driver, words: str, picture: str = ""):
    """Search the library, and take what comes first."""
    yield from driver.type("l")
    yield 0.5
    yield from driver.type(words)
    yield 0.5
    if picture:
        driver.photograph(picture)
    yield from driver.key("RET")
    yield 0.7
