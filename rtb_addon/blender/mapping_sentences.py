"""What conditions change in a scene, in words: spectra that vary, properties, written lines."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Any, NamedTuple

import bpy

from ..errors import RecipeError
from .conditions import VARIABLE
from .mapped import cells_by_name, value_for
from .place_words import thing_word
from .places import place_of
from .table_edits import spoken_fields
from .written_mappings import Written, written_lines

_ICONS = {"Object": "OBJECT_DATA", "Light": "LIGHT", "Camera": "CAMERA_DATA", "Material": "MATERIAL"}
_ICONS |= {"World": "WORLD", "Mesh": "MESH_DATA", "Scene": "SCENE_DATA", "Key": "SHAPEKEY_DATA"}
_KINDS = {"material": "material", "light": "light", "mesh": "mesh", "camera": "camera"}
_SET = re.compile(r"([^:]+):([\w.|=]+?)(?:\.\w+)? (=|\+=|-=|\*=|/=) (.*)")
_DECLARED = re.compile(r"([^:]+):(\w+):(\w+)")


class Spectral(NamedTuple):
    """
    A spectrum that names variables.

    Parameters
    ----------
    group, name : where its text is kept
    missing : why it cannot be, if it cannot
    """

    subject: str
    icon: str
    group: Any
    name: str
    missing: str


class Line(NamedTuple):
    """A line of the written mappings, as a sentence where it has one."""

    sentence: str
    icon: str
    number: int
    missing: str


class Lines(NamedTuple):
    """The written mappings, and why they cannot be read if they cannot."""

    lines: list[Line]
    problem: str


def spectra_that_vary(scene) -> list[Spectral]:
    """Return the spectra of the file that name variables."""
    known = {each.name for each in scene.rtb.variables}
    found = []
    for group, name in spoken_fields():
        if "(" not in (text := getattr(group, name)) or not (used := VARIABLE.findall(text)):
            continue
        thing = group.id_data
        called = f"{group.bl_rna.properties[name].name} of the {thing_word(thing)} {thing.name}"
        found.append(Spectral(called, icon_of(thing), group, name, _unknown(used, known)))
    return found


def missing(scene, mapping) -> str:
    """Return why a property cannot be set in the active condition, nothing where it can."""
    settings = scene.rtb
    try:
        if settings.active_condition < len(settings.conditions):
            value_for(mapping, cells_by_name(settings, settings.conditions[settings.active_condition]))
        else:
            place_of(mapping)
    except RecipeError as error:
        return str(error).removeprefix(f"{mapping.name}: ")
    return ""


def written(scene) -> Lines:
    """Return the lines of the written mappings as sentences."""
    lines, problem = written_lines(scene)
    known = {each.name for each in scene.rtb.variables}
    return Lines([_line(each, known) for each in lines], problem)


def icon_of(thing) -> str:
    """Return the icon that Blender has for a datablock."""
    return _ICONS.get(type(thing).__name__, next((i for k, i in _ICONS.items() if _is(thing, k)), "RNA"))


def _is(thing, kind: str) -> bool:
    return isinstance(thing, getattr(bpy.types, kind))


def _line(said: Written, known: set[str]) -> Line:
    words = [name for name in VARIABLE.findall(said.text) if re.fullmatch(r"[A-Za-z_]\w*", name)]
    lost = _unknown(words, known) or _gone(said)
    icon = {"collada": "EMPTY_AXIS", "generic": "SHADING_RENDERED"}.get(said.kind.lower(), "RENDER_STILL")
    return Line(sentence_of(said.kind, said.group, said.text), icon, said.line, lost)


@lru_cache(maxsize=1024)
def sentence_of(kind: str, group: str, text: str) -> str:
    """Return what a line of mappings says in words, the line itself where there are none."""
    badge = "" if kind.lower() in ("collada", "generic") else f"[{kind}] "
    when = f" (group {group})" if group else ""
    if found := _SET.fullmatch(text.strip()):
        thing, what, operator, value = found.groups()
        verb = {"=": "=", "+=": "is more by", "-=": "is less by", "*=": "is times", "/=": "is divided by"}[
            operator
        ]
        return f"{badge}{_property(what)} of {_thing(thing)} {verb} {_value(value)}{when}"
    if found := _DECLARED.fullmatch(text.strip()):
        return f"{badge}{_thing(found[1])} is a {found[3]} {found[2]}{when}"
    return f"{badge}{text.strip()}{when}"


def _thing(id: str) -> str:
    name, _, kind = id.rpartition("-")
    return f"the {_KINDS[kind]} {name}" if name and kind in _KINDS else id


def _property(path: str) -> str:
    last = path.split(":")[-1]
    name = last.partition("=")[2] or last
    words = re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).split()
    said = " ".join(each if each.isupper() else each.lower() for each in words)
    return said[:1].upper() + said[1:]


def _value(text: str) -> str:
    return re.sub(r"\(([A-Za-z_]\w*)\)", r"variable \1", text)


def _unknown(used: list[str], known: set[str]) -> str:
    lost = [name for name in used if name not in known]
    return f"no variable is called {lost[0]}" if lost else ""


def _gone(said: Written) -> str:
    """Return what a line speaks of that is not in the file."""
    name, _, kind = said.text.partition(":")[0].strip().rpartition("-")
    homes = {"material": "materials", "light": "lights", "camera": "cameras", "mesh": "meshes"}
    if not name or kind not in homes or said.kind.lower() not in ("collada", "generic"):
        return ""
    from ..scene.collada.ids import clean

    there = {clean(each.name) for each in getattr(bpy.data, homes[kind])}
    there |= {clean(each.name) for each in bpy.data.lights} if kind == "mesh" else set()  # area lamps
    return "" if name in there or "(" in name else f"no {kind} is called {name}"
