"""What the docs tell people to type in Blender works."""

import re
from pathlib import Path

import bpy
import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
BLOCKS = [
    pytest.param(text, id=page.name)
    for page in sorted(DOCS.rglob("*.md"))
    for text in re.findall(r"^```python\n(.*?)^```", page.read_text(), re.M | re.S)
    if "import bpy" in text
]


@pytest.mark.parametrize("code", BLOCKS)
def test_python_for_blender_in_the_docs_runs(code, scene, lamp, box, tmp_path):
    lamp()
    body = box("Body")
    body.modifiers.new("Subdivision", "SUBSURF")
    body.shape_key_add(name="Basis")
    body.shape_key_add(name="Smile").data[0].co.z -= 1
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    made = {"__name__": "docs"}
    exec(compile(code, "docs", "exec"), made)
    assert (made["folder"] / "recipe.json").is_file()
    assert "colladaFile" in (made["folder"] / "conditions.txt").read_text()
