"""
What enabling the extension costs Blender, as processor time: the least of some starts of the bpy package.

    python benchmarks/enabling.py [starts]

The first start compiles the extension's files, which Blender pays once after each installation.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[1] / "tests/blender/light_process.py"


def milliseconds() -> float:
    """Return what one start says [ms]."""
    with tempfile.TemporaryDirectory() as home:
        said = subprocess.run([sys.executable, str(SCRIPT), home], capture_output=True, text=True, check=True)
    return float(re.search(r"enabled in (\S+) ms", said.stdout)[1])


if __name__ == "__main__":
    starts = [milliseconds() for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 4)]
    print(f"enabling: {min(starts[1:] or starts):.0f} ms of processor time (first start {starts[0]:.0f} ms)")
