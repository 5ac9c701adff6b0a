"""What one condition changes in the parent scene: its mappings, filled in, in the order of the file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from ..errors import RecipeError


class NativeLine(NamedTuple):
    """
    A line of a renderer's own block, that has no neutral meaning.

    Parameters
    ----------
    text : the line with its variables filled in
    file, line : where it stands
    block : type of its block as the file writes it, such as Mitsuba or Mitsuba-path
    found : the file that its value names, if it names one
    """

    text: str
    file: str
    line: int
    block: str = ""
    found: Path | None = None


class PathEdit(NamedTuple):
    """A change of the Collada document: a path, one of ``= += -= *= /=`` and a value."""

    path: str
    operator: str
    value: str
    file: str
    line: int


class MatrixEdit(NamedTuple):
    """All transforms of a node, by its id, replaced by one matrix: 16 numbers, row by row, for columns."""

    node: str
    numbers: tuple[float, ...]
    file: str
    line: int


class Removal(NamedTuple):
    """A node, or all that places a light, camera or geometry, taken out of the document."""

    id: str
    file: str
    line: int


Edit = PathEdit | MatrixEdit | Removal


class Property(NamedTuple):
    """
    A property of a neutral object.

    Parameters
    ----------
    type : how the value is written: spectrum, rgb, float, texture ...; may be empty
    found : the file that the value names, if it names one
    """

    name: str
    type: str
    value: str
    file: str
    line: int
    found: Path | None = None


@dataclass(frozen=True)
class NeutralObject:
    """
    What one Generic block says about one id.

    Parameters
    ----------
    id : of something in the parent scene, or a new one
    category : material, light, floatTexture or spectrumTexture; empty where the block declares nothing
    model : its kind in the vocabulary, such as matte
    properties : in the order of the block
    file, line : where the id comes first in its block
    """

    id: str
    category: str
    model: str
    properties: tuple[Property, ...]
    file: str
    line: int


class Remark(NamedTuple):
    """Something odd that is not wrong."""

    message: str
    file: str
    line: int | None

    def __str__(self) -> str:
        return str(RecipeError(self.message, self.file, self.line))


@dataclass(frozen=True)
class Adjustments:
    """
    All that a condition's mappings say, for one renderer.

    Parameters
    ----------
    edits : changes of the Collada document
    objects : materials, lights and textures, in the vocabulary
    native : lines of the renderer's own blocks
    remarks : what is odd about them
    """

    edits: tuple[Edit, ...] = ()
    objects: tuple[NeutralObject, ...] = ()
    native: tuple[NativeLine, ...] = ()
    remarks: tuple[Remark, ...] = ()
