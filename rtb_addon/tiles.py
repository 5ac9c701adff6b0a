"""The grid of a montage: which condition's pixel lies where in the picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from .montage import grid, place
from .recipe.options import MontageOptions


@dataclass(frozen=True)
class Tiles:
    """
    Which condition lies where in a picture.

    Parameters
    ----------
    names : of the conditions, in the order of the montage
    rows, columns, fill : of the grid
    width, height : of a cube [pixels]
    reduced : how many pixels of a cube, across and down, are one of the picture
    """

    names: tuple[str, ...]
    rows: int
    columns: int
    fill: str
    width: int
    height: int
    reduced: int = 1

    @classmethod
    def of(
        cls, names: Sequence[str], size: tuple[int, int], options: MontageOptions, reduced: int = 1
    ) -> Tiles:
        """Return how a montage of cubes of a size (width, height) is arranged."""
        return cls(tuple(names), *grid(len(names), options), options.fill, *size, reduced)

    @classmethod
    def from_words(cls, words: Mapping[str, Any]) -> Tiles:
        """Return what to_words() wrote."""
        return cls(**{**words, "names": tuple(words["names"])})

    def to_words(self) -> dict[str, Any]:
        """Return them as JSON can write them."""
        return asdict(self)

    @property
    def tile(self) -> tuple[int, int]:
        """Width and height of a condition in the picture [pixels of the picture]."""
        return self.width // self.reduced, self.height // self.reduced

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture [pixels of the picture]."""
        width, height = self.tile
        return self.columns * width, self.rows * height

    def corner(self, number: int) -> tuple[int, int]:
        """Return the left and upper edge of a condition [pixels of the picture]; numbers begin at 0."""
        row, column = place(number, self.rows, self.columns, self.fill)
        width, height = self.tile
        return column * width, row * height

    def at(self, x: float, y: float) -> tuple[str, int, int] | None:
        """Return whose pixel lies at a place [pixels of the picture], with its column and row in the cube."""
        width, height = self.tile
        column, row = int(x // width), int(y // height)
        if not (0 <= column < self.columns and 0 <= row < self.rows):
            return None
        number = row * self.columns + column if self.fill == "rows" else column * self.rows + row
        if number >= len(self.names):
            return None
        across, down = x - column * width, y - row * height
        return self.names[number], int(across * self.reduced), int(down * self.reduced)

    def within(self, name: str, x: float, y: float) -> tuple[int, int]:
        """Return the column and the row of the pixel of a condition that is nearest to a place."""
        left, top = self.corner(self.names.index(name))
        across, down = int((x - left) * self.reduced), int((y - top) * self.reduced)
        return min(max(across, 0), self.width - 1), min(max(down, 0), self.height - 1)
