"""What things are called in the scene, and their order there: layers go by that, not by ids of the file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from urllib.parse import quote, unquote
from xml.etree import ElementTree as Xml

from ....scene.render_scene import RenderScene
from .names import Names

OBJECTS, MATERIALS = "objects", "materials"


def called(scene: RenderScene, names: Names) -> Iterator[Xml.Element]:
    """Yield what tells objects, lamps that are balls among them, and materials, as defaults in the file."""
    balls = [lamp.id for lamp in scene.lights if lamp.parameters.get("radius")]
    things = {
        OBJECTS: [*(("shape", shape.id) for shape in scene.shapes), *(("emitter", id) for id in balls)],
        MATERIALS: [("material", id) for id in scene.materials],
    }
    for kind, ids in things.items():
        places = {names.of_once(*id): id[1] for id in ids}
        yield _default(kind, " ".join(places))
        yield from (_default(f"{place}_called", quote(id)) for place, id in places.items() if place != id)


def names_in_order(defaults: Mapping[str, str], kind: str) -> dict[str, str]:
    """Return the names of objects or of materials by their ids in the file, in the scene's order."""
    places = defaults.get(kind, "").split()
    return {place: unquote(defaults.get(f"{place}_called", place)) for place in places}


def _default(name: str, value: str) -> Xml.Element:
    return Xml.Element("default", name=name, value=value)
