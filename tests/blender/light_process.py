"""Run in a process of its own: enable, export and render, then list what Blender's process has imported."""

import importlib.util
import os
import sys
from pathlib import Path

home = Path(sys.argv[1])
os.environ["BLENDER_USER_RESOURCES"] = str(home / "user")

import bpy  # noqa: E402  isort: skip  only now does it see the folder
import addon_utils  # noqa: E402

HEAVY = {"mitsuba", "drjit", "colour", "scipy", "OpenEXR", "embreex", "matplotlib", "PIL"}
ROOT = Path(__file__).resolve().parents[2]
EXTENSION = "bl_ext.user_default.render_toolbox"

spec = importlib.util.spec_from_file_location("link_extension", ROOT / "packaging/link_extension.py")
script = importlib.util.module_from_spec(spec)
spec.loader.exec_module(script)
script.link_extension(home / "user")

assert addon_utils.enable(EXTENSION, default_set=True) is not None
bpy.ops.wm.save_as_mainfile(filepath=str(home / "cube.blend"))
settings = bpy.context.scene.rtb
settings.renderer, settings.samples, settings.width, settings.height = "tracer", 1, 8, 8
assert bpy.ops.rtb.export_recipe() == {"FINISHED"}
assert bpy.ops.rtb.render_recipe() == {"FINISHED"}
print("heavy modules:", ", ".join(sorted(HEAVY & set(sys.modules))) or "none")
