"""Blender's own Python module, with a user folder of its own and the extension enabled from this checkout."""

import importlib.util
import os
import tempfile
from pathlib import Path

# Before the first `import bpy`: nobody's own Blender settings are read or written.
os.environ["BLENDER_USER_RESOURCES"] = tempfile.mkdtemp(prefix="rtb-blender-user-")

import bpy  # noqa: F401  before addon_utils can be found
import pytest

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = "bl_ext.user_default.render_toolbox"


@pytest.fixture(scope="session")
def extension() -> str:
    """Enable the extension as Blender does, and return the name it has there."""
    import addon_utils

    spec = importlib.util.spec_from_file_location("link_extension", ROOT / "packaging/link_extension.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    script.link_extension(Path(os.environ["BLENDER_USER_RESOURCES"]))
    assert addon_utils.enable(EXTENSION, default_set=True) is not None, "the extension does not enable"
    return EXTENSION
