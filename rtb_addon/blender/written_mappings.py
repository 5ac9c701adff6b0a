"""Mappings that somebody has written, in RenderToolbox3's words, in a text of Blender's."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import bpy

from ..errors import RecipeError


class Written(NamedTuple):
    """
    A line of the written mappings.

    Parameters
    ----------
    kind, group : of its block
    text : as it stands there
    line : counted from 1
    """

    kind: str
    group: str
    text: str
    line: int


def written_mappings(scene) -> str:
    """Return the mappings of a scene's text, empty where it has none; raise what is wrong with them."""
    text = scene.rtb.mappings_text
    if text is None:
        return ""
    from ..mappings import parse_mappings

    said = text.as_string().rstrip()
    parse_mappings(said, text.name)
    return f"{said}\n" if said else ""


def declared_in(scene) -> set[str]:
    """Return the ids that written mappings declare themselves, in Generic blocks for all conditions."""
    lines, _ = written_lines(scene)
    said = [each.text for each in lines if each.kind.lower() == "generic" and not each.group]
    return {found[1] for text in said if (found := _DECLARED.fullmatch(text))}


def resources_of(scene) -> dict[str, bytes]:
    """Return the files that written mappings and cells may name, by their names below resources/."""
    if not (said := scene.rtb.resources.strip()):
        return {}
    folder = Path(bpy.path.abspath(said))
    if not folder.is_dir():
        raise RecipeError(f"there is no folder {folder}, in which the spectra of this recipe lay")
    files = [each for each in sorted(folder.rglob("*")) if each.is_file()]
    return {each.relative_to(folder).as_posix(): each.read_bytes() for each in files}


def written_lines(scene) -> tuple[list[Written], str]:
    """Return the lines of a scene's written mappings, and why they cannot be read if they cannot."""
    text = scene.rtb.mappings_text
    said = "" if text is None else text.as_string()
    if (text and text.name, said) != _known["text"]:
        _known["text"], _known["lines"] = (text and text.name, said), _parsed(said, text.name if text else "")
    return _known["lines"]


def _parsed(said: str, name: str) -> tuple[list[Written], str]:
    if not said.strip():
        return [], ""
    from ..mappings.blocks import parse_blocks

    try:
        blocks, _ = parse_blocks(said, name)
    except RecipeError as error:
        return [], str(error)
    return [Written(b.kind, b.group, each.text.strip(), each.line) for b in blocks for each in b.mappings], ""


def rewrite(scene, line: int, text: str) -> None:
    """Replace a line, which keeps its indent, of a scene's written mappings."""
    lines = _text_of(scene).lines
    if not 1 <= line <= len(lines):
        raise RecipeError(f"the mappings have no line {line}, they have {len(lines)}")
    old = lines[line - 1].body
    lines[line - 1].body = old[: len(old) - len(old.lstrip())] + text.strip()


def remove(scene, line: int) -> None:
    """Take a line out of a scene's written mappings."""
    text = _text_of(scene)
    lines = [each.body for each in text.lines]
    if not 1 <= line <= len(lines):
        raise RecipeError(f"the mappings have no line {line}, they have {len(lines)}")
    text.from_string("\n".join([*lines[: line - 1], *lines[line:]]))


def text_for(scene) -> bpy.types.Text:
    """Return the text of a scene's written mappings, a new one that says how where there is none."""
    if scene.rtb.mappings_text is None:
        scene.rtb.mappings_text = bpy.data.texts.new("Mappings")
        scene.rtb.mappings_text.write(_BEGINNING)
    return scene.rtb.mappings_text


def _text_of(scene) -> bpy.types.Text:
    if scene.rtb.mappings_text is None:
        raise RecipeError("the scene has no mappings of its own, press Edit as Text")
    return scene.rtb.mappings_text


_BEGINNING = """% What conditions change, in the words of RenderToolbox3; see docs/formats.md.
% (name) stands for a variable of the table. Lines like this one are comments.
Generic {
}
"""
_DECLARED = re.compile(r"([^:.$=\s]+):(?:material|light):\w+")
_known: dict = {"text": None, "lines": ([], "")}
