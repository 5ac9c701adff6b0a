"""Run in a real window: spectra and recipes dropped on it, as from a file manager."""

import shutil
import struct
import subprocess
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from driver import Driver
from scene import extension, make_recipe

DROPPING = Path(__file__).with_name("xdnd.py")
OLD = ("parent.dae", "conditions.txt", "mappings.txt")


def drops(driver: Driver, folder: Path):
    """Drop spectra, then recipes in each of their forms."""
    folder.mkdir(parents=True, exist_ok=True)
    yield from spectra(driver, folder)
    make_recipe(folder, 2, "tracer", samples=8, size=(80, 60))
    bpy.ops.rtb.export_recipe()
    yield from recipes(driver, folder / "rtb/cube", folder / "old")


def spectra(driver: Driver, folder: Path):
    """Drop a file of each kind on another editor, all at once, and one where it means something else."""
    pairs, table, toolbox = (folder / name for name in ("my paint.spd", "two.csv", "sur_three.mat"))
    pairs.write_text("400 0.2\n500 0.5\n700 0.9\n")
    table.write_text("nm,low,high\n400,0.2,0.3\n500,0.5,.6\n700,0.9,1\n")
    values = [0.1] * 31 + [0.5] * 31 + [0.9] * 31
    toolbox.write_bytes(matlab("S_three", 1, 3, [400, 10, 31]) + matlab("sur_three", 31, 3, values))
    for area, file in (("VIEW_3D", pairs), ("PROPERTIES", table), ("OUTLINER", toolbox)):
        yield from drop(driver, area, file)
        driver.report[file.suffix] = own_spectra()
        shutil.rmtree(extension("rtb_addon.blender.own_spectra").folder_for_imports())
    yield from drop(driver, "VIEW_3D", pairs, table, toolbox)
    driver.report["all spectra"] = own_spectra()
    driver.photograph("dropped-spectra")


def recipes(driver: Driver, folder: Path, old: Path):
    """Drop a recipe's json, RenderToolbox3's three files, RenderToolbox4's two, and a folder."""
    yield from drop(driver, "VIEW_3D", folder / "recipe.json")
    driver.report["recipe.json"] = opened(driver)
    old.mkdir()
    for name in OLD:
        shutil.copy(folder / name, old / name)
    yield from drop(driver, "OUTLINER", *(old / name for name in OLD))
    driver.report["old recipe"] = opened(driver)
    driver.photograph("dropped-recipe")
    (old / "newer.json").write_text(
        '[{"name": "Camera", "broadType": "cameras", "operation": "update", "properties": []}]'
    )
    shutil.copy(old / "parent.dae", old / "newer.dae")
    yield from drop(driver, "VIEW_3D", old / "newer.dae", old / "newer.json")
    driver.report["json recipe"] = opened(driver)
    scenes = len(bpy.data.scenes)
    yield from drop(driver, "VIEW_3D", folder)
    driver.report["scenes of a folder"] = len(bpy.data.scenes) - scenes


def drop(driver: Driver, kind: str, *files: Path):
    """Let another process drop files on the middle of an area, and wait until Blender has done its work."""
    area = driver.area(kind)
    x, y = area.x + area.width // 2, driver.window.height - area.y - area.height // 2
    command = [sys.executable, DROPPING, x, y, *files]
    source = subprocess.Popen([str(each) for each in command], stdout=subprocess.PIPE, text=True)
    while source.poll() is None:
        yield 0.1
    driver.report.setdefault("taken", []).append(source.stdout.read().strip())
    yield 0.8


def own_spectra() -> list[str]:
    folders = extension("rtb_addon.blender.own_spectra").own_folders()
    return sorted(extension("rtb_addon.spectra.library").own_files(folders))


def opened(driver: Driver) -> list:
    """Return what the window shows: the recipe's name, its conditions, the objects of its scene."""
    scene = driver.window.scene
    return [scene.rtb.name, [row.name for row in scene.rtb.conditions], len(scene.objects)]


def matlab(name: str, rows: int, columns: int, values: list[float]) -> bytes:
    """Return an array in a file of MATLAB's level 4."""
    head = struct.pack("<5i", 0, rows, columns, 0, len(name) + 1)
    return head + name.encode() + b"\0" + struct.pack(f"<{len(values)}d", *values)


if __name__ == "__main__":
    report_file, home, pictures = map(Path, sys.argv[sys.argv.index("--") + 1 :])
    bpy.context.preferences.view.show_splash = False
    driver = Driver(report_file, pictures)
    driver.run(drops(driver, home))
