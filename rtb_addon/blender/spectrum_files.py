"""The spectra and pictures of a recipe as files below its resources/."""

from __future__ import annotations

import re
from pathlib import Path

from ..spectra import Spectrum
from ..spectra.files import spd_text
from .statements import Picture

_FOLDER = "resources"


class SpectrumFiles:
    """The spectra and pictures of a recipe as files below resources/, each content once under each name."""

    def __init__(self) -> None:
        self.contents: dict[str, bytes] = {}
        self._known: dict[str, str] = {}  # names that are taken, in whatever letters' case

    def add(self, name: str, spectrum: Spectrum) -> str:
        """Return the path, in the recipe's folder, of a spectrum's file."""
        return self._keep(stem_of(name), ".spd", spd_text(spectrum).encode())

    def picture(self, picture: Picture) -> str:
        """Return the path, in the recipe's folder, of a picture's file."""
        file = Path(picture.name)
        return self._keep(stem_of(file.stem), file.suffix.lower(), picture.content)

    def _keep(self, stem: str, ending: str, content: bytes) -> str:
        number = 1
        while True:
            file = f"{stem}{f'-{number}' if number > 1 else ''}{ending}"
            twin = self._known.setdefault(file.casefold(), file)
            if twin == file and self.contents.setdefault(file, content) == content:
                return f"{_FOLDER}/{file}"
            number += 1


def stem_of(said: str) -> str:
    """Return what was typed as the name of a file: that of a file without its folder and ending."""
    name = said.strip()
    if name.lower().endswith(".spd"):
        name = re.split(r"[/\\]", name)[-1][:-4]
    return re.sub(r"[^\w.-]+", "-", name).strip("-.") or "spectrum"
