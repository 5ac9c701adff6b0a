"""Where the files of old recipes are looked for."""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cached_property
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from ..errors import RecipeError
from ..recipe.resources import leads_outside


class Search:
    """
    Looks files up beside the old ones and in data folders, and nowhere else.

    Parameters
    ----------
    beside : folders of the old files; only they and their resources/ are searched
    data : folders that are searched with everything below
    """

    def __init__(self, beside: Iterable[Path], data: Iterable[Path]) -> None:
        self._beside = [place for folder in dict.fromkeys(beside) for place in (folder, folder / "resources")]
        self._data = list(data)
        for folder in self._data:
            if not folder.is_dir():
                raise RecipeError(f"{folder} is no folder, --data must name folders")

    def find(self, name: str) -> Path | None:
        """Return the file of a name; one that leads elsewhere is looked up by its base name, as ever."""
        for plain in dict.fromkeys((name.replace("\\", "/"), unquote(name.removeprefix("file://")))):
            base = PurePosixPath(plain.replace("\\", "/")).name
            wanted = [base] if leads_outside(plain) else [plain, base]
            for place in (*self._beside, *self._data):
                for each in wanted:
                    if each and os.path.isfile(place / each) and self._inside(place / each):  # noqa: PTH113
                        return place / each
            if base in self._below_data:
                return self._below_data[base]
        return None

    def _inside(self, file: Path) -> bool:
        folders = (*self._beside, *self._data)
        return any(file.resolve().is_relative_to(folder.resolve()) for folder in folders)

    @cached_property
    def _below_data(self) -> dict[str, Path]:
        found: dict[str, Path] = {}
        for folder in self._data:
            for place, below, files in os.walk(folder):
                below.sort()
                for name in sorted(files):
                    if self._inside(Path(place) / name):
                        found.setdefault(name, Path(place) / name)
        return found
