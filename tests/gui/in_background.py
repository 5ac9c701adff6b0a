"""Run by ``blender -b``: the installed extension renders a small recipe with both renderers."""

import json
import sys
import traceback
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))  # Blender does not look beside its scripts
from scene import EXTENSION, make_recipe

HEAVY = {"mitsuba", "drjit", "colour", "scipy", "OpenEXR", "embreex"}


def attempt() -> str:
    """Press Render Recipe, and return what it said or the sentence that it raised."""
    try:
        return next(iter(bpy.ops.rtb.render_recipe()))
    except RuntimeError as error:
        return str(error).strip()


def found_out(folder: Path) -> dict:
    """Render with both renderers, then without a camera."""
    report = {"enabled": EXTENSION in bpy.context.preferences.addons, "version": bpy.app.version_string}
    make_recipe(folder, 2, "tracer", samples=4, size=(32, 24))
    for renderer in ("tracer", "mitsuba"):
        bpy.context.scene.rtb.renderer = renderer
        report[renderer] = attempt()
    report["files"] = sorted(
        path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()
    )
    report["images"] = {image.name: list(image.size) for image in bpy.data.images if image.get("rtb_montage")}
    bpy.data.objects.remove(bpy.context.scene.camera)
    report["without camera"] = attempt()
    report["heavy modules"] = sorted(HEAVY & set(sys.modules))
    return report


if __name__ == "__main__":
    target, folder = sys.argv[sys.argv.index("--") + 1 :]
    try:
        report = found_out(Path(folder))
    except BaseException:
        report = {"traceback": traceback.format_exc()}
    Path(target).write_text(json.dumps(report, indent=1))
    sys.exit(4 if "traceback" in report else 0)
