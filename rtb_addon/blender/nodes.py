"""What can be read from Blender's shader nodes without a renderer: one colour of a material or world."""

from __future__ import annotations

from typing import NamedTuple

_COLOURED = {"BSDF_PRINCIPLED": "Base Color", "BSDF_DIFFUSE": "Color"}
_OUTPUTS = ("OUTPUT_MATERIAL", "OUTPUT_WORLD")


class Found(NamedTuple):
    """
    A colour of Blender's working space, and where it was found.

    Parameters
    ----------
    textured : whether a texture stands in its place, which was not read
    """

    colour: tuple[float, float, float]
    place: str
    textured: bool = False


def colour_of_material(material) -> Found:
    """Return the base colour of a material's principled or diffuse shader, else its viewport colour."""
    if not material.use_nodes or material.node_tree is None:
        return Found(_three(material.diffuse_color), "viewport colour")
    node = _surface_node(material.node_tree)
    if node is None or node.type not in _COLOURED:
        return Found(_three(material.diffuse_color), "viewport colour")
    socket = node.inputs[_COLOURED[node.type]]
    return Found(_three(socket.default_value), socket.name.lower(), socket.is_linked)


def is_black(world) -> bool:
    """Return whether Blender's world sends out no light."""
    if not world.use_nodes or world.node_tree is None:
        return max(world.color) <= 0
    node = _surface_node(world.node_tree)
    if node is None:
        return True
    if node.type != "BACKGROUND" or any(socket.is_linked for socket in node.inputs):
        return False
    dark = max(_three(node.inputs["Color"].default_value)) <= 0
    return dark or node.inputs["Strength"].default_value <= 0


def _surface_node(tree):
    """Return the node that the active output shows, or None."""
    outputs = [node for node in tree.nodes if node.type in _OUTPUTS]
    chosen = next((node for node in outputs if node.is_active_output), None)
    if chosen is None or not chosen.inputs["Surface"].is_linked:
        return None
    return chosen.inputs["Surface"].links[0].from_node


def _three(colour) -> tuple[float, float, float]:
    red, green, blue = list(colour)[:3]
    return red, green, blue
