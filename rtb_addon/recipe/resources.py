"""Files of a recipe by name: inside its folder, or those that RenderToolbox3 served to everybody."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
from contextlib import suppress
from functools import cached_property
from pathlib import Path, PurePosixPath, PureWindowsPath
from urllib.parse import unquote

from ..errors import RecipeError
from ..files import write_bytes
from ..scene.archives import files_beside
from ..spectra.files import spd_text
from ..spectra.library import served

# What a batch writes itself; a file there never stands in for one of the recipe.
GENERATED = {"scenes", "renderings", "layers", "images", "comparisons"}


class Resources:
    """
    Looks files up in a recipe's folder, each name once.

    Attributes
    ----------
    served : names of the files that came from the library
    unpacked : names of the files that came out of a parent scene's .zae
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.served: list[str] = []
        self.unpacked: list[str] = []
        self._found: dict[str, Path | None] = {}

    def find(self, name: str) -> Path | None:
        """
        Return the file of a name, or None: resources/ first, then the folder, then by base name in it.

        Spectra that RenderToolbox3 served, such as D65.spd, and pictures that lie in a parent scene's .zae,
        are written into resources/ with a warning.
        A name that leads out of the folder finds a file of its base name inside, or raises.
        """
        if name not in self._found:
            self._found[name] = self._inside(name) or self._unpacked(name) or self._served(name)
            if self._found[name] is None:
                refuse_outside(name)
        return self._found[name]

    @property
    def warnings(self) -> list[str]:
        """What somebody should know about where files came from, a sentence each."""
        origins = {
            "the library's own went into resources/ for what the recipe lacked": self.served,
            "files of a .zae went into resources/": self.unpacked,
        }
        return [f"{origin}: {listed(names)}" for origin, names in origins.items() if names]

    def _inside(self, name: str) -> Path | None:
        for plain in dict.fromkeys((name.replace("\\", "/"), unquote(name.removeprefix("file://")))):
            if not leads_outside(plain):
                for candidate in (self.folder / "resources" / plain, self.folder / plain):
                    # os.path says no where pathlib raises: a name may be any text of a cell.
                    if plain and os.path.isfile(candidate):  # noqa: PTH113
                        return self._kept_inside(candidate)
            if file := self._by_base_name.get(PurePosixPath(plain).name):
                return self._kept_inside(file)
        return None

    def _kept_inside(self, file: Path) -> Path:
        if not file.resolve().is_relative_to(self.folder.resolve()):
            raise RecipeError(f"{file} leads outside the recipe's folder, put the file itself there")
        return file

    @cached_property
    def _by_base_name(self) -> dict[str, Path]:
        found: dict[str, Path] = {}
        for place, folders, files in os.walk(self.folder):
            inside = Path(place) != self.folder
            folders[:] = sorted(f for f in folders if "." not in f and (inside or f not in GENERATED))
            for file in sorted(files):
                if not file.startswith(".") and not file.endswith("~"):
                    found.setdefault(file, Path(place) / file)
        return found

    def _served(self, name: str) -> Path | None:
        if (spectrum := served(name)) is None:
            return None
        self.served.append(name)
        return self._brought(PureWindowsPath(name).name, spd_text(spectrum).encode())

    def _unpacked(self, name: str) -> Path | None:
        file = PureWindowsPath(unquote(name)).name
        if (archive := self._archived.get(file)) is None:
            return None
        self.unpacked.append(f"{file} of {archive.name}")
        packed = {PurePosixPath(path).name: content for path, content in files_beside(archive).items()}
        return self._brought(file, packed[file])

    @cached_property
    def _archived(self) -> dict[str, Path]:
        """The archives that hold files, by their base names."""
        found: dict[str, Path] = {}
        for file in self._by_base_name.values():
            if file.suffix.lower() == ".zae":
                with suppress(RecipeError):  # what is wrong with it is for its reader to say
                    found = {PurePosixPath(name).name: file for name in files_beside(file)} | found
        return found

    def _brought(self, file: str, content: bytes) -> Path:
        """Write a file into resources/ and return it."""
        try:
            write_bytes(self.folder / "resources" / file, content)
            return self.folder / "resources" / file
        except RecipeError:  # a recipe that may only be read can still be checked
            write_bytes(self._elsewhere / file, content)
            return self._elsewhere / file

    @cached_property
    def _elsewhere(self) -> Path:
        folder = tempfile.mkdtemp(prefix="rtb-")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        return Path(folder)


def listed(names: list[str], most: int = 3) -> str:
    """Return some names for a sentence, the first ones of many."""
    rest = len(names) - most
    return ", ".join(names[:most]) + (f" and {rest} more" if rest > 0 else "")


def leads_outside(name: str) -> bool:
    """Return whether a name leads out of the folder it is looked up in."""
    absolute = PurePosixPath(name).is_absolute() or PureWindowsPath(name).is_absolute()
    return absolute or ".." in PureWindowsPath(name).parts


def refuse_outside(name: str) -> None:
    """Raise one sentence when a name leads out of the folder it is looked up in."""
    if leads_outside(name):
        raise RecipeError(f"{name} lies outside the recipe's folder, copy the file into resources/")
