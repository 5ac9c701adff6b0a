"""
The blocks of a mappings file, line by line as RenderToolbox3 reads them.

What it read without a word though it looks like an accident comes with a remark here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from ..errors import at
from ..scene.adjustments import Remark
from ..scene.paths import parse_path
from .lines import Statement, count_parts, parse_statement

# Renderers of old recipes, and ours; the lines of their blocks are checked when a file is read.
RENDERERS = ("mitsuba", "pbrt", "tracer", "radiance", "cycles", "sphere")

_COMMENT = re.compile(r"\s*%")
_START = re.compile(r"(?:([^\s{]+)\s+)?([^\s{]+)\s*\{")
_MAPPING = re.compile(r"\S.")


class Mapping(NamedTuple):
    """A line of a block, as it is written, and where."""

    text: str
    line: int


@dataclass(frozen=True)
class Block:
    """
    Lines between braces.

    Parameters
    ----------
    kind : Collada, Generic, a renderer's name, or that name with -path
    group : the group that it belongs to, empty for none
    line : where it begins
    mappings : its lines without comments
    """

    kind: str
    group: str
    line: int
    mappings: tuple[Mapping, ...] = ()

    @property
    def holds_paths(self) -> bool:
        """Whether its lines are paths into a document, not scene targets."""
        return self.kind.lower() == "collada" or self.kind.lower().endswith("-path")

    @property
    def known(self) -> bool:
        """Whether its kind is one of the language itself or of a renderer of ours."""
        return self.kind.lower().removesuffix("-path") in ("collada", "generic", *RENDERERS)

    def applies(self, group: str) -> bool:
        """Return whether it counts for a condition of a group; all blocks count where there is none."""
        return not group or not self.group or group == self.group


def parse_blocks(text: str, file: str | Path) -> tuple[tuple[Block, ...], tuple[Remark, ...]]:
    """Return a file's blocks and what is odd in it; raise where a line of a known block cannot be read."""
    reader = _Reader(str(file))
    for number, line in enumerate(text.split("\n"), 1):
        reader.take(line.removesuffix("\r"), number)
    if reader.open:
        reader.remark("the block that begins here never ends, close it with }", reader.blocks[-1].line)
    for block in reader.blocks:
        for mapping in block.mappings if block.known else ():
            statement = statement_of(block, mapping, file)
            if why := lost(block, statement):
                reader.remark(why, mapping.line)
    return tuple(reader.blocks), tuple(reader.remarks)


def format_blocks(blocks: Iterable[Block]) -> str:
    """Return the text that parse_blocks() reads back as the same blocks."""
    return "\n".join(_formatted(block) for block in blocks)


def statement_of(block: Block, mapping: Mapping, file: str | Path) -> Statement:
    """Return a line taken apart; raise for half a pair of brackets and for what should be a path."""
    with at(file, mapping.line):
        statement = parse_statement(mapping.text)
        if block.holds_paths and statement.operator:
            parse_path(statement.left.value)
        return statement


def lost(block: Block, statement: Statement) -> str:
    """Return why RenderToolbox3 dropped a line, as we do, or nothing."""
    left = statement.left.value
    if not statement.operator and ("=" in left or block.holds_paths):
        return f"'{left}' holds no operator and is lost, write it with spaces around an ="
    if block.holds_paths:
        return ""
    parts = count_parts(left)
    if parts == 3 or (parts == 2 and statement.operator):
        return ""
    return f"cannot read '{left}', which is lost; want id:category:type or id:property.type = value"


def _formatted(block: Block) -> str:
    head = f"{block.kind} {block.group} {{" if block.group else f"{block.kind} {{"
    return "\n".join([head, *(f"    {each.text}" for each in block.mappings), "}", ""])


@dataclass
class _Reader:
    """What has been read so far."""

    file: str
    blocks: list[Block] = field(default_factory=list)
    remarks: list[Remark] = field(default_factory=list)
    open: bool = False

    def take(self, line: str, number: int) -> None:
        if _COMMENT.match(line):
            return
        if start := _START.search(line):
            self._begin(start, line, number)
        elif "}" in line:
            self._end(line, number)
        elif found := _MAPPING.search(line):
            # A trailing blank can be the one that an operator needs.
            self._add(Mapping(line[found.start() :], number))

    def remark(self, message: str, number: int) -> None:
        self.remarks.append(Remark(message, self.file, number))

    def _begin(self, start: re.Match[str], line: str, number: int) -> None:
        if self.open:
            self.remark("a block begins inside another one, which ends here without its }", number)
        for lost in (line[: start.start()].strip(), line[start.end() :].strip()):
            if lost:
                self.remark(f"'{lost}' is lost: a block begins with its type, its group and a {{", number)
        first, second = start.groups()
        kind, group = (first, second) if first else (second, "")
        self.blocks.append(Block(kind, group, number))
        self.open = True

    def _end(self, line: str, number: int) -> None:
        if lost := line.replace("}", "").strip():
            self.remark(f"'{lost}' is lost: a block's }} stands alone on its line", number)
        if not self.open:
            self.remark("a } without a block", number)
        self.open = False

    def _add(self, mapping: Mapping) -> None:
        if not self.open:
            # RenderToolbox3 gave strays to the block before them, unless that was empty.
            if not (self.blocks and self.blocks[-1].mappings):
                self.remark("a line outside of all blocks does nothing", mapping.line)
                return
            self.remark(f"a line after the }} counts to the {self.blocks[-1].kind} block above", mapping.line)
        last = self.blocks[-1]
        self.blocks[-1] = Block(last.kind, last.group, last.line, (*last.mappings, mapping))
