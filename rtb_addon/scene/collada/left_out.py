"""What a Collada file from anywhere holds that no picture of ours shows, said in a sentence each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ..document import Scene
from ..paths import Element, local_name

# Libraries that RenderToolbox3 dropped, and what they hold.
_DROPPED = {
    "animations": "animations",
    "animation_clips": "animation clips",
    "force_fields": "force fields",
    "physics_materials": "physics materials",
    "physics_models": "physics models",
    "physics_scenes": "physics scenes",
    "kinematics_models": "kinematics models",
    "kinematics_scenes": "kinematics scenes",
    "articulated_systems": "articulated systems",
    "joints": "joints",
}
_TRACKS = ("track", "keyframe", "ipo")


def left_out(document: Scene) -> Iterator[str]:
    """Yield a sentence for every kind of thing that is there and left out."""
    for library in document.root:
        name = local_name(library).removeprefix("library_")
        held = [each for each in library if local_name(each) not in ("", "asset", "extra")]
        if local_name(library).startswith("library_") and name in _DROPPED and held:
            yield f"{len(held)} {_DROPPED[name]} are left out, the scene stands still"
    tracks = sum(local_name(each) in _TRACKS for node in document.of_kind("node") for each in _extras(node))
    if tracks:
        yield f"{tracks} tracks inside nodes are left out, the scene stands still"
    for id, count in Counter(filter(None, (each.get("id") for each in document.root.iter("{*}*")))).items():
        if count > 1:
            yield f"{count} elements have the id {id}, the last one is meant wherever it is named"


def _extras(node: Element) -> Iterator[Element]:
    for extra in node.iterchildren("{*}extra"):
        yield from extra.iter("{*}*")
