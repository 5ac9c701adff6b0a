"""RenderToolbox3's blocks filled in for one condition and one renderer."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple

from ..errors import RecipeError, at
from ..scene.adjustments import Adjustments, NativeLine, NeutralObject, PathEdit, Property
from .blocks import Block, lost, statement_of
from .filling import Filling
from .lines import Side, Target, parse_target
from .native_document import NATIVE, NativeDocument

# Renderers that read the Mitsuba blocks of a recipe that has none of their own.
_LIKE_MITSUBA = ("tracer", "radiance", "cycles")
# Types of values that no text in parentheses can be.
_NUMERIC = ("", "spectrum", "rgb", "color", "float", "integer")
# Materials of Mitsuba 0.5 that old files declare as if they were Generic ones.
_OLD_MATERIALS = ("ward", "diffuse", "roughdiffuse", "dielectric", "roughdielectric", "conductor")
_OLD_MATERIALS += ("roughconductor", "phong", "coating", "roughcoating", "thindielectric", "twosided")


class _Filled(NamedTuple):
    """A line with its variables, its path in brackets and its file looked up."""

    left: str
    operator: str
    value: str
    line: int
    found: Path | None


def fill_blocks(blocks: Sequence[Block], filling: Filling, renderer: str) -> Adjustments:
    """Return what those blocks say that apply to the filling's condition."""
    chosen = [block for block in blocks if block.applies(filling.group)]
    _remark_strangers(chosen, renderer, filling)
    return _Filler(filling, native_name(renderer, (block.kind for block in blocks))).filled(chosen)


def native_name(renderer: str, kinds: Iterable[str]) -> str:
    """Return, in small letters, whose native words a renderer reads where those of some kinds are there."""
    own = renderer.lower()
    has_own = any(kind.lower().removesuffix("-path") == own for kind in kinds)
    return "mitsuba" if own in _LIKE_MITSUBA and not has_own else own


@dataclass
class _Filler:
    """What blocks have said so far, one after the other."""

    filling: Filling
    renderer: str
    edits: list[PathEdit] = field(default_factory=list)
    objects: list[NeutralObject] = field(default_factory=list)
    native: list[NativeLine] = field(default_factory=list)

    def filled(self, blocks: Iterable[Block]) -> Adjustments:
        self.document = NativeDocument.of(self.renderer)
        for block in blocks:
            self._take(block)
        remarks = tuple(dict.fromkeys(self.filling.remarks))
        return Adjustments(tuple(self.edits), tuple(self.objects), tuple(self.native), remarks)

    def _take(self, block: Block) -> None:
        kind = block.kind.lower()
        if kind == "collada":
            self.edits += (self._edit(line) for line in self._lines(block))
        elif kind == "generic":
            for each in self._objects(block):
                self._take_object(each)
        elif kind == self.renderer:
            for line in self._lines(block):
                self._take_native(_native_line(self._file, line, block.kind))
        elif kind == f"{self.renderer}-path":
            for line in self._lines(block):
                self.native += self._changed_at(line, block.kind)

    @property
    def _file(self) -> str:
        return self.filling.file

    def _lines(self, block: Block) -> Iterator[_Filled]:
        for mapping in block.mappings:
            statement = statement_of(block, mapping, self._file)
            if why := lost(block, statement):
                self.filling.remark(why, mapping.line)
                continue
            with at(self._file, mapping.line):
                left = self.filling.substituted(statement.left.value)
                value = self._value(statement.right, mapping.line)
                found = self.filling.found(value)
                self._refuse_unfilled(block, left, "" if found else value, mapping.line)
            yield _Filled(left, statement.operator, value, mapping.line, found)

    def _value(self, side: Side, line: int) -> str:
        text = self.filling.substituted(side.value)
        if side.enclosing == "[]":
            return self.filling.at_path(text, line)
        if side.enclosing != "<>":
            return text
        if (value := self.document.value_at(text)) is None:
            whose = self.renderer.capitalize()
            self.filling.remark(f"{whose}'s adjustments have nothing at <{text}>, the value is empty", line)
        return value or ""

    def _refuse_unfilled(self, block: Block, left: str, value: str, line: int) -> None:
        """Raise for an unknown variable where numbers must stand; elsewhere it stays, as it always did."""
        message = self.filling.unknown_variable(value)
        numeric = block.kind.lower() == "generic" and parse_target(left).type in _NUMERIC
        if message and numeric:
            raise ValueError(message)
        for each in filter(None, (message, self.filling.unknown_variable(left))):
            self.filling.remark(f"{each}, so the text stays as it is", line)

    def _edit(self, line: _Filled) -> PathEdit:
        return PathEdit(line.left, line.operator, line.value, self._file, line.line)

    def _take_native(self, line: NativeLine) -> None:
        with at(line.file, line.line):
            self.document.take(line.text)
        self.native.append(line)

    def _changed_at(self, line: _Filled, block: str) -> list[NativeLine]:
        with at(self._file, line.line):
            change = self.document.change(line.left, line.operator, line.value, self.filling.document)
        if change.remark:
            self.filling.remark(change.remark, line.line)
        return [NativeLine(text, self._file, line.line, block, line.found) for text in change.lines]

    def _take_object(self, each: NeutralObject) -> None:
        category = "bsdf" if each.category == "material" and each.model in _OLD_MATERIALS else each.category
        if category not in NATIVE:
            self.objects.append(each)
        elif self.renderer == "mitsuba":
            for line in _native_lines(each, category):
                self._take_native(line)

    def _objects(self, block: Block) -> Iterable[NeutralObject]:
        """Return what a block says, by id: all its lines about one id are one object."""
        found: dict[str, NeutralObject] = {}
        for line in self._lines(block):
            with at(self._file, line.line):
                target = parse_target(line.left)
            known = found.get(target.id) or NeutralObject(target.id, "", "", (), self._file, line.line)
            if line.operator:
                known = replace(known, properties=(*known.properties, self._property(known, target, line)))
            else:
                known = replace(known, category=target.name, model=target.type, line=line.line)
            found[target.id] = known
        return found.values()

    def _property(self, owner: NeutralObject, target: Target, line: _Filled) -> Property:
        if line.operator != "=":
            self.filling.remark(f"{line.operator} acts like = here, arithmetic needs a path block", line.line)
        for each in owner.properties:
            if each.name == target.name:  # RenderToolbox3 stopped here
                message = f"{target.name} of {owner.id} is set in line {each.line} already, once is enough"
                raise RecipeError(message, self._file, line.line)
        return Property(target.name, target.type, line.value, self._file, line.line, line.found)


def _native_line(file: str, line: _Filled, block: str) -> NativeLine:
    text = f"{line.left} {line.operator} {line.value}" if line.operator else line.left
    return NativeLine(text, file, line.line, block, line.found)


def _native_lines(thing: NeutralObject, category: str) -> Iterator[NativeLine]:
    """Yield an object of Mitsuba's own categories in a Generic block as lines of a Mitsuba block."""
    yield NativeLine(f"{thing.id}:{category}:{thing.model}", thing.file, thing.line, "Mitsuba")
    for each in thing.properties:
        target = f"{thing.id}:{each.name}.{each.type}" if each.type else f"{thing.id}:{each.name}"
        yield NativeLine(f"{target} = {each.value}", each.file, each.line, "Mitsuba", each.found)


def _remark_strangers(blocks: Iterable[Block], renderer: str, filling: Filling) -> None:
    known = (renderer.lower(), f"{renderer.lower()}-path")
    for block in blocks:
        if not block.known and block.kind.lower() not in known:
            message = f"nobody reads a block of type {block.kind}, want Collada, Generic or a renderer"
            filling.remark(message, block.line)
