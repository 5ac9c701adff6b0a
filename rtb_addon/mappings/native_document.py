"""
What RenderToolbox3 kept beside the scene for a renderer: its adjustments, an XML document.

Blocks such as ``Mitsuba-path`` change it by paths and ``<path>`` reads it. What a path says becomes the
line that a ``Mitsuba`` block would say it with, so that renderers know one way only; the document itself
serves look-ups and arithmetic, and begins with RenderToolbox3's defaults.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

from ..scene.paths import Child, Element, ScenePath, find, local_name, numbers_in, parse_path, read, write
from .lines import parse_statement, parse_target

if TYPE_CHECKING:
    from ..scene.document import Scene

# Mitsuba's own categories: old files write them into Generic blocks too.
NATIVE = (
    "bsdf",
    "emitter",
    "texture",
    "shape",
    "sensor",
    "film",
    "sampler",
    "integrator",
    "medium",
    "rfilter",
)

_DEFAULTS = {
    "mitsuba": """<scene>
        <integrator id="integrator" type="direct"><integer name="shadingSamples" value="32"/></integrator>
        <sampler id="Camera-camera_sampler" type="ldsampler"><integer name="sampleCount" value="8"/></sampler>
        <merge id="Camera-camera_film" type="hdrfilm"><string name="fileFormat" value="openexr"/>
            <string name="pixelFormat" value="spectrum"/><string name="componentFormat" value="float16"/>
            <boolean name="banner" value="false"/>
            <rfilter type="gaussian"><float name="stddev" value="0.5"/></rfilter></merge></scene>""",
    "pbrt": """<pbrt_xml><SurfaceIntegrator id="integrator" type="directlighting"/>
        <Sampler id="sampler" type="lowdiscrepancy">
            <parameter name="pixelsamples" type="integer">8</parameter></Sampler>
        <PixelFilter id="filter" type="gaussian"><parameter name="alpha" type="float">2</parameter>
            <parameter name="xwidth" type="float">2</parameter>
            <parameter name="ywidth" type="float">2</parameter></PixelFilter>
        <Film id="film" type="image"/></pbrt_xml>""",
}
# What an element is whose name is only ``merge``: known by its id.
_KINDS = {
    "mitsuba": (("_film", "film"), ("_sampler", "sampler"), ("-camera", "sensor"), ("-light", "emitter")),
    "pbrt": (("-camera", "Camera"), ("-light", "LightSource"), ("-material", "Material")),
}


class Change(NamedTuple):
    """What a path line comes to: lines of a block without paths, and what is odd about it."""

    lines: tuple[str, ...] = ()
    remark: str = ""


class NativeDocument:
    """One condition's adjustments for one renderer, as its blocks change them in turn."""

    def __init__(self, root: Element, renderer: str) -> None:
        self.root, self._renderer = root, renderer

    @classmethod
    def of(cls, renderer: str) -> NativeDocument:
        """Return a renderer's adjustments before any block."""
        from lxml import etree

        return cls(etree.fromstring(_DEFAULTS.get(renderer, "<scene/>")), renderer)

    def value_at(self, path: str) -> str | None:
        """Return the text or attribute that a path leads to, or None."""
        return read(self.root, parse_path(path))

    def take(self, line: str) -> None:
        """Put a line that declares or configures an element into the document."""
        statement = parse_statement(line)
        target = parse_target(statement.left.value)
        known = find(self.root, ScenePath("", target.id))
        if not statement.operator:
            if known is not None:
                known.getparent().remove(known)
            made = self.root.makeelement(target.name, {"id": target.id, "type": target.type})
            self.root.insert(0, made)
            return
        if known is not None:
            for each in [each for each in known if each.get("name") == target.name]:
                known.remove(each)
        child = Child(target.type or "string", "name", target.name)
        if self._renderer == "pbrt":
            child = Child("parameter", "name", target.name)
            write(self.root, ScenePath("", target.id, (child,), "type"), "=", target.type)
        attribute = "" if self._renderer == "pbrt" else "value"
        write(self.root, ScenePath("", target.id, (child,), attribute), "=", statement.right.value)

    def change(self, left: str, operator: str, value: str, scene: Scene) -> Change:
        """Change what a path leads to; return what a renderer is to be told."""
        path = parse_path(left)
        write(self.root, path, operator, value)
        if path.naming:
            # Elements that merge keep what the importer made of them, as ours always do.
            harmless = value == "merge" and not (path.children or path.attribute)
            return Change() if harmless else Change((f"{left} {operator} {value}",))
        now = read(self.root, path) or ""
        if path.attribute == "intent":
            return Change(remark="colours are promoted by what they are used for, their intent is left out")
        if _is_parallel_view(path, now, scene):
            return Change(remark="a parallel view has its width from the parent scene, so that is left out")
        if not path.children and path.attribute == "type" and is_projection(path.id, now, scene):
            return Change()
        return Change(tuple(self._lines(path, now)) or (f"{left} = {now}",))

    def _lines(self, path: ScenePath, now: str) -> Iterable[str]:
        if not path.children:
            return [f"{path.id}:{self._category(path.id)}:{now}"] if path.attribute == "type" else []
        *outer, last = path.children
        if last.key != "name" or len(outer) > 1:
            return []
        owner, declared = (path.id, []) if not outer else _inner(outer[0])
        if owner and self._renderer == "pbrt" and last.name == "parameter":
            kind = read(self.root, ScenePath("", path.id, path.children, "type"))
            if path.attribute == "type":
                text = read(self.root, ScenePath("", path.id, path.children))
                return [*declared, f"{owner}:{last.value}.{kind} = {text}"] if text else declared
            target = f"{owner}:{last.value}.{kind}" if kind else f"{owner}:{last.value}"
            return [*declared, f"{target} = {now}"] if not path.attribute else []
        if owner and path.attribute in ("value", "filename", "id"):
            kind = "texture" if last.name == "ref" else last.name
            return [*declared, f"{owner}:{last.value}.{kind} = {now}"]
        return []

    def _category(self, id: str) -> str:
        element = find(self.root, ScenePath("", id))
        if element is not None and (name := local_name(element)) != "merge":
            return name
        return next((kind for end, kind in _KINDS.get(self._renderer, ()) if id.endswith(end)), "merge")


def is_projection(id: str, kind: str, scene: Scene) -> bool:
    """Return whether a camera of the parent scene has a projection, so that asking for it says nothing."""
    lens = ScenePath("", id, (Child("optics"), Child("technique_common"), Child(kind)))
    return kind in ("perspective", "orthographic") and find(scene.root, lens) is not None


def _inner(child: Child) -> tuple[str, list[str]]:
    """Return the id of what stands inside another element, and its declaration: a film's filter."""
    if child.name != "rfilter":
        return "", []
    return "filter", [f"filter:rfilter:{child.value}"] if child.key == "type" else []


def _is_parallel_view(path: ScenePath, now: str, scene: Scene) -> bool:
    """Return whether a line only gives an orthographic camera its own width, which Mitsuba 0.5 forgot."""
    inner = (Child("transform", "name", "toWorld"), Child("scale"))
    if path.children != inner or path.attribute not in ("x", "y"):
        return False
    width = scene.value_at(f"{path.id}:optics:technique_common:orthographic:xmag")
    return width is not None and numbers_in(width) == numbers_in(now)
