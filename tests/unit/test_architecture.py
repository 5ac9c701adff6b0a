"""The floors of the house: imports go down, and only some rooms know Blender."""

import ast
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FLOORS = {
    "__init__.py": 8,
    "panels": 7,
    "operators": 6,
    "rtb_addon/__main__.py": 6,
    "rtb_addon/command_line.py": 6,
    "rtb_addon/progress.py": 6,
    "rtb_addon/pictures.py": 6,
    "rtb_addon/blender": 5,
    "rtb_addon/batch": 5,
    "rtb_addon/kept_cubes.py": 5,
    "rtb_addon/looks.py": 5,
    "rtb_addon/viewer.py": 5,
    "rtb_addon/worker.py": 5,
    "rtb_addon/old_recipes": 5,
    "rtb_addon/compare.py": 5,
    "rtb_addon/montage.py": 4,
    "rtb_addon/renderers": 4,
    "rtb_addon/recipe": 4,
    "rtb_addon/probe_tables.py": 4,
    "rtb_addon/probing.py": 4,
    "rtb_addon/developing.py": 4,
    "rtb_addon/thumbnails.py": 4,
    "rtb_addon/tiles.py": 4,
    "rtb_addon/views.py": 4,
    "rtb_addon/colorimetry.py": 3,
    "rtb_addon/colour_difference.py": 3,
    "rtb_addon/colour_rendering.py": 3,
    "rtb_addon/observers.py": 3,
    "rtb_addon/photometry.py": 3,
    "rtb_addon/spectral_image.py": 3,
    "rtb_addon/layers.py": 3,
    "rtb_addon/swatches.py": 3,
    "rtb_addon/mappings": 3,
    "rtb_addon/spectra": 2,
    "rtb_addon/scene": 2,
    "rtb_addon/conditions.py": 2,
    "rtb_addon/curves.py": 2,
    "rtb_addon/designs.py": 2,
    "rtb_addon/exr.py": 2,
    "rtb_addon/archive_rules.py": 1,
    "rtb_addon/background.py": 1,
    "rtb_addon/child_environment.py": 1,
    "rtb_addon/consent.py": 1,
    "rtb_addon/digits.py": 1,
    "rtb_addon/spreadsheets.py": 1,
    "rtb_addon/errors.py": 1,
    "rtb_addon/files.py": 1,
    "rtb_addon/units.py": 1,
    "rtb_addon/user_folders.py": 1,
    "rtb_addon/processes.py": 1,
    "rtb_addon/lifeline.py": 1,
}
BLENDER = {"bpy", "mathutils", "gpu", "bpy_extras", "addon_utils"}
BLENDER_ROOMS = ("__init__.py", "operators", "panels", "rtb_addon/blender")


def modules():
    rooms = ["__init__.py", "panels/*.py", "operators/*.py", "rtb_addon/**/*.py"]
    return [path for room in rooms for path in ROOT.glob(room)]


def room_of(relative: str) -> str | None:
    return next((r for r in FLOORS if relative == r or relative.startswith(r + "/")), None)


def imported(path: Path):
    """Yield (line, name): paths below the root for relative imports, a folder with a slash; else names."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name.split(".")[0]) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.lineno, (node.module or "").split(".")[0]
        elif isinstance(node, ast.ImportFrom):
            base = path.parents[node.level - 1] / (node.module or "").replace(".", "/")
            for alias in node.names:
                target = next((t for t in (base / f"{alias.name}.py", base / alias.name) if t.exists()), base)
                target = target if target.exists() else base.with_suffix(".py")
                yield node.lineno, target.relative_to(ROOT).as_posix() + "/" * target.is_dir()


def test_imports_go_down():
    wrong = []
    for path in modules():
        relative = path.relative_to(ROOT).as_posix()
        here = room_of(relative)
        for line, name in imported(path):
            there = room_of(name)
            if here and there and there != here and FLOORS[there] > FLOORS[here]:
                wrong.append(f"{relative}:{line} imports {name}, which is above it")
    assert not wrong, "\n".join(wrong)


def test_every_module_has_a_floor():
    public = ("rtb_addon/__init__.py", "rtb_addon/data")
    strays = [
        name
        for path in modules()
        if room_of(name := path.relative_to(ROOT).as_posix()) is None and not name.startswith(public)
    ]
    assert not strays


def test_only_the_bridge_and_what_stands_on_it_knows_blender():
    wrong = [
        f"{relative}:{line} imports {name}"
        for path in modules()
        if not (relative := path.relative_to(ROOT).as_posix()).startswith(BLENDER_ROOMS)
        for line, name in imported(path)
        if name in BLENDER
    ]
    assert not wrong, "\n".join(wrong)


def test_our_own_packages_are_imported_relatively():
    ours = {"rtb_addon", "operators", "panels"}
    wrong = [f"{path.name}:{line}" for path in modules() for line, name in imported(path) if name in ours]
    assert not wrong


def test_nobody_touches_the_search_path():
    assert not [path.name for path in modules() if "sys.path" in path.read_text()]


def test_what_blender_reads_from_annotations_is_no_text():
    """Blender would have each one compiled when the extension is enabled, which takes 5 ms."""
    wrong = []
    for path in modules():
        tree = ast.parse(path.read_text())
        said = {node.module for node in tree.body if isinstance(node, ast.ImportFrom)}
        bodies = (each.body for each in ast.walk(tree) if isinstance(each, ast.ClassDef))
        lines = (line for body in bodies for line in body if isinstance(line, ast.AnnAssign))
        if "__future__" in said and any(isinstance(line.annotation, ast.Call) for line in lines):
            wrong.append(path.name)
    assert not wrong
