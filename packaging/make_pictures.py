"""
Renew the pictures of Blender's window in docs/: python packaging/make_pictures.py

They are the photographs that a newcomer's ten minutes leave (pytest tests/gui -k newcomer), or parts of them.
"""

from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
# Photograph -> its name in docs/ and the part that is shown: left, top, right, bottom [pixels].
PICTURES = {
    "newcomer-2-blue": ("first-material", (420, 165, 1280, 700)),
    "newcomer-5-patches": ("first-table", (420, 165, 1280, 720)),
    "newcomer-8-pointing": ("first-probe", (0, 0, 1280, 800)),
}


def renew(photograph: str) -> Path:
    """Write a photograph of the last window test as a picture of the docs, and return that."""
    name, part = PICTURES[photograph]
    file = ROOT / f"docs/{name}.png"
    with Image.open(ROOT / f"build/screenshots/{photograph}.png") as taken:
        taken.convert("RGB").crop(part).save(file, optimize=True)
    return file


if __name__ == "__main__":
    for photograph in PICTURES:
        print(renew(photograph))
