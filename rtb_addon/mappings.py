"""
The mappings of a recipe: what each condition changes in the parent scene.

Reading finds blocks and lines; filling in, once for each condition, puts the row's values into the
lines of those blocks that apply and sorts them into edits, neutral objects and native lines.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from .conditions import Condition, decoded
from .errors import RecipeError, at, choices
from .scene.adjustments import Adjustments, NativeLine, NeutralObject, PathEdit, Property, Remark
from .scene.blocks import Block, parse_blocks, statement_of
from .scene.lines import Side, Target, parse_target

if TYPE_CHECKING:
    from .scene.document import Scene

FindFile = Callable[[str], Path | None]

# Renderers that read the Mitsuba blocks of a recipe that has none of their own.
_LIKE_MITSUBA = ("tracer", "radiance", "cycles")
# Mitsuba's own categories: old files write them into Generic blocks too.
_NATIVE = ("bsdf", "emitter", "texture", "shape", "sensor", "film", "sampler", "integrator", "medium")
_UNFILLED = re.compile(r"\(([A-Za-z_]\w*)\)")
_FILE_NAME = re.compile(r"\.\S*$")
_NUMBERS = re.compile(r"[-+.\d:eE\s]*")


@dataclass(frozen=True)
class Mappings:
    """
    A mappings file, kept whole.

    Parameters
    ----------
    text : of the file
    file : its name, for messages
    """

    text: str = ""
    file: str = "mappings.txt"

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        """Its blocks, in the order of the file."""
        return self._parsed[0]

    @cached_property
    def _parsed(self) -> tuple[tuple[Block, ...], tuple[Remark, ...]]:
        return parse_blocks(self.text, self.file)

    def fill_in(
        self, condition: Condition, renderer: str, document: Scene, find_file: FindFile
    ) -> Adjustments:
        """
        Return what the mappings say for one condition and one renderer.

        Parameters
        ----------
        document : the parent scene as it is before any mapping, where ``[path]`` looks
        find_file : returns the recipe's file of a name, or None
        """
        group = condition.cells.get("groupName", "")
        blocks = [block for block in self.blocks if block.applies(group)]
        filling = _Filling(self.file, condition, document, find_file)
        native = _native_name(renderer, self.blocks)
        edits, objects, lines = [], [], []
        for block in blocks:
            kind = block.kind.lower()
            if kind == "collada":
                edits += map(filling.edit, filling.lines(block))
            elif kind == "generic":
                objects += filling.objects(block)
            elif kind.removesuffix("-path") == native:
                lines += [filling.native(line, block.kind) for line in filling.lines(block)]
        if native == "mitsuba":
            lines += [line for each in objects for line in _native_lines(each)]
        neutral = tuple(each for each in objects if each.category not in _NATIVE)
        remarks = (*self._parsed[1], *_strangers(blocks, renderer, self.file), *filling.remarks)
        return Adjustments(tuple(edits), neutral, tuple(lines), remarks)


def read_mappings(path: Path | str) -> Mappings:
    """Read a mappings file."""
    try:
        content = Path(path).read_bytes()
    except OSError as error:
        raise RecipeError(f"cannot read the mappings {path}: {error.strerror}") from error
    return parse_mappings(decoded(content), path)


def parse_mappings(text: str, file: str | Path) -> Mappings:
    """Return the mappings in a text; raise what is wrong with its lines."""
    mappings = Mappings(text, str(file))
    mappings.blocks  # noqa: B018  reading is what raises
    return mappings


def format_mappings(mappings: Mappings) -> str:
    """Return the text of a mappings file, its comments and blanks as they were."""
    return mappings.text


class _Filled(NamedTuple):
    """A line with its variables, its ``[path]`` and its file looked up."""

    left: str
    operator: str
    value: str
    line: int
    found: Path | None


@dataclass
class _Filling:
    """One condition's values, put into lines."""

    file: str
    condition: Condition
    document: Scene
    find_file: FindFile
    remarks: list[Remark] = field(default_factory=list)

    def lines(self, block: Block) -> Iterator[_Filled]:
        for mapping in block.mappings:
            statement = statement_of(block, mapping, self.file)
            with at(self.file, mapping.line):
                left = self._substituted(statement.left.value)
                value = self._value(statement.right, mapping.line)
                found = self._found(value)
                for text in (left, "" if found else value):
                    self._refuse_unfilled(text)
            yield _Filled(left, statement.operator, value, mapping.line, found)

    def edit(self, line: _Filled) -> PathEdit:
        return PathEdit(line.left, line.operator, line.value, self.file, line.line)

    def native(self, line: _Filled, block: str) -> NativeLine:
        text = f"{line.left} {line.operator} {line.value}" if line.operator else line.left
        return NativeLine(text, self.file, line.line, block, line.found)

    def objects(self, block: Block) -> Iterable[NeutralObject]:
        """Return what a block says, by id: all its lines about one id are one object."""
        found: dict[str, NeutralObject] = {}
        for line in self.lines(block):
            with at(self.file, line.line):
                target = parse_target(line.left)
            known = found.get(target.id) or NeutralObject(target.id, "", "", (), self.file, line.line)
            if line.operator:
                known = replace(known, properties=(*known.properties, self._property(target, line)))
            else:
                known = replace(known, category=target.name, model=target.type, line=line.line)
            found[target.id] = known
        return found.values()

    def _property(self, target: Target, line: _Filled) -> Property:
        if line.operator != "=":
            message = f"{line.operator} acts like = here, arithmetic needs a Collada block"
            self.remarks.append(Remark(message, self.file, line.line))
        return Property(target.name, target.type, line.value, self.file, line.line, line.found)

    def _substituted(self, text: str) -> str:
        for variable, cell in self.condition.cells.items():
            text = text.replace(f"({variable})", cell)
        return text

    def _value(self, side: Side, line: int) -> str:
        text = self._substituted(side.value)
        if side.enclosing == "<>":
            message = f"<{text}> is not looked up, no renderer here keeps such a document"
            self.remarks.append(Remark(message, self.file, line))
        if side.enclosing != "[]":
            return text
        if (value := self.document.value_at(text)) is None:
            raise ValueError(f"the parent scene has no value at [{text}]")
        return value

    def _found(self, value: str) -> Path | None:
        """Return the file that a value names: a dot, then no more blanks, tells that it may be one."""
        plain = not _FILE_NAME.search(value) or _NUMBERS.fullmatch(value)
        return None if plain else self.find_file(value)

    def _refuse_unfilled(self, text: str) -> None:
        if unknown := _UNFILLED.search(text):
            known = choices(unknown[1], self.condition.cells)
            raise ValueError(f"no variable is called {unknown[1]}, the conditions have {known}")


def _native_name(renderer: str, blocks: Iterable[Block]) -> str:
    """Return, in small letters, whose blocks a renderer reads."""
    own = renderer.lower()
    has_own = any(block.kind.lower().removesuffix("-path") == own for block in blocks)
    return "mitsuba" if own in _LIKE_MITSUBA and not has_own else own


def _native_lines(thing: NeutralObject) -> list[NativeLine]:
    """Return an object of Mitsuba's own categories in a Generic block as lines of a Mitsuba block."""
    if thing.category not in _NATIVE:
        return []
    declaration = NativeLine(f"{thing.id}:{thing.category}:{thing.model}", thing.file, thing.line, "Mitsuba")
    return [declaration, *(_native_line(thing.id, each) for each in thing.properties)]


def _native_line(id: str, each: Property) -> NativeLine:
    target = f"{id}:{each.name}.{each.type}" if each.type else f"{id}:{each.name}"
    return NativeLine(f"{target} = {each.value}", each.file, each.line, "Mitsuba", each.found)


def _strangers(blocks: Iterable[Block], renderer: str, file: str) -> list[Remark]:
    """Return a remark for each block of a kind that nobody knows."""
    known = (renderer.lower(), f"{renderer.lower()}-path")
    return [
        Remark(
            f"nobody reads a block of type {block.kind}, want Collada, Generic or a renderer",
            file,
            block.line,
        )
        for block in blocks
        if not block.known and block.kind.lower() not in known
    ]
