"""
Let Blender see this checkout as the extension, without building a zip.

    BLENDER_USER_RESOURCES=FOLDER python packaging/link_extension.py

links the checkout to FOLDER/extensions/user_default/render_toolbox. Every Blender and every bpy that starts
with the same BLENDER_USER_RESOURCES then has it, to be enabled in the preferences or by a script:

    addon_utils.enable("bl_ext.user_default.render_toolbox", default_set=True)
"""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def link_extension(user_resources: Path) -> Path:
    """Link the checkout into Blender's user folder and return the link."""
    link = user_resources / "extensions/user_default/render_toolbox"
    link.parent.mkdir(parents=True, exist_ok=True)
    if link.is_symlink():
        link.unlink()
    if link.exists():
        raise SystemExit(f"{link} is an installed extension: remove it in Blender first")
    link.symlink_to(ROOT, target_is_directory=True)
    return link


if __name__ == "__main__":
    if not (folder := os.environ.get("BLENDER_USER_RESOURCES")):
        raise SystemExit(
            "set BLENDER_USER_RESOURCES to the user folder of the Blender that shall see the extension"
        )
    print(link_extension(Path(folder)))
