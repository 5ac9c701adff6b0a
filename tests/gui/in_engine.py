"""Run in a real window: RenderToolbox as Blender's render engine, by F12 and Esc."""

import sys
import time
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from in_window import LONG, children, properties
from scene import make_recipe


def rendering(driver: Driver, folder: Path):
    """Choose the engine, look at its settings, render by F12, then break a rendering off."""
    make_recipe(folder, 2, "tracer", samples=100, size=(160, 120))
    scene = bpy.context.scene
    driver.report["folder"] = str(folder)
    scene.render.engine = "RENDERTOOLBOX"
    scene.rtb.active_condition = 1
    bpy.context.preferences.view.render_display_type = "AREA"
    for tab, name in (("RENDER", "engine-render"), ("MATERIAL", "engine-material"), ("DATA", "engine-light")):
        yield from properties(driver, tab, "Light" if tab == "DATA" else "Cube")
        driver.photograph(name)
    yield from press_f12(driver)
    driver.report["seen while rendering"] = [bpy.app.is_job_running("RENDER"), len(children()) > 0]
    while bpy.app.is_job_running("RENDER"):
        yield 0.1
    yield 1.0
    driver.photograph("engine-result")
    cubes = [file for file in (folder / "rtb/cube/still").rglob("*.exr") if "renderings" in file.parts]
    driver.report["cubes"] = [cube.name for cube in cubes]
    bpy.data.images["Render Result"].save_render(str(folder / "result.png"), scene=scene)
    driver.report["result"] = mean_of(folder / "result.png")
    yield from break_off(driver)


def press_f12(driver: Driver):
    """Press F12 over the viewport, and wait until the rendering is at work in a process of its own."""
    yield from driver.press("F12", "VIEW_3D")
    deadline = time.monotonic() + 10
    while not (bpy.app.is_job_running("RENDER") and children()) and time.monotonic() < deadline:
        yield 0.05


def break_off(driver: Driver):
    """Start a rendering that nobody waits for, and press Esc."""
    bpy.context.scene.rtb.samples = LONG
    area = driver.area("IMAGE_EDITOR") or driver.area("VIEW_3D")
    yield from driver.press("F12", area.type)
    while not children():
        yield 0.1
    yield 1.0
    # Of simulated keys Blender's jobs hear nothing; in_escape.py presses a real one.
    x, y = cancel_button(driver, driver.photograph("engine-rendering"))
    begin = time.perf_counter()
    yield from driver.click(x, y)
    while (bpy.app.is_job_running("RENDER") or children()) and time.perf_counter() - begin < 10:
        yield 0.05
    driver.report["stopped after"] = time.perf_counter() - begin
    driver.report["left"] = children()


def cancel_button(driver: Driver, picture) -> tuple[float, float]:
    """Return where the button is that ends Blender's job: the last one in the status bar."""
    import numpy as np

    height = 12
    theme = bpy.context.preferences.themes[0].user_interface.wcol_tool.inner
    colour = np.round(np.array(theme[:3]) * 255)
    same = np.abs(picture[height].astype(float) - colour).max(axis=1) <= 2
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(int)))
    runs = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 3]
    driver.report["buttons in the status bar"] = [[int(a), int(b)] for a, b in runs]
    return sum(runs[-1]) / 2, height


def mean_of(file: Path) -> list[float]:
    """Return the mean colour of a picture."""
    import numpy as np

    image = bpy.data.images.load(str(file))
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(-1, 4)[:, :3].mean(axis=0).tolist()


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(rendering(driver, home))
