"""What can be read from Blender's shader nodes without a renderer: one colour of a material or world."""

from __future__ import annotations

from typing import Any, NamedTuple

_COLOURED = {"BSDF_PRINCIPLED": "Base Color", "BSDF_DIFFUSE": "Color"}
_GLOWING = {
    "BSDF_PRINCIPLED": ("Emission Color", "Emission Strength"),
    "EMISSION": ("Color", "Strength"),
}
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
    if not has_nodes(material):
        return Found(_three(material.diffuse_color), "viewport colour")
    node = surface_node(material.node_tree)
    if node is None or node.type not in _COLOURED:
        return Found(_three(material.diffuse_color), "viewport colour")
    socket = node.inputs[_COLOURED[node.type]]
    return Found(_three(socket.default_value), socket.name.lower(), socket.is_linked)


def base_colour(thing):
    """Return the socket that holds the one colour of a material or world, None where it has none."""
    node = surface_node(thing.node_tree) if has_nodes(thing) else None
    name = {**_COLOURED, "BACKGROUND": "Color"}.get("" if node is None else node.type)
    socket = None if node is None or name is None else node.inputs[name]
    return None if socket is None or socket.is_linked else socket


def glows(material) -> bool:
    """Return whether a material's nodes make it send out light of its own."""
    node = surface_node(material.node_tree) if has_nodes(material) else None
    if node is None or node.type not in _GLOWING:
        return False
    colour, strength = (node.inputs[name] for name in _GLOWING[node.type])
    linked = colour.is_linked or strength.is_linked
    return linked or (strength.default_value > 0 and max(_three(colour.default_value)) > 0)


def has_nodes(thing) -> bool:
    """Return whether nodes say what a material, world or lamp does; in Blender 5 they always do."""
    return getattr(thing, "use_nodes", True) and thing.node_tree is not None


def surface_node(tree):
    """Return the node that the active output shows, or None."""
    outputs = [node for node in tree.nodes if node.type in _OUTPUTS]
    chosen = next((node for node in outputs if node.is_active_output), None)
    if chosen is None or not chosen.inputs["Surface"].is_linked:
        return None
    return chosen.inputs["Surface"].links[0].from_node


def relief_of(node) -> tuple[str, Any, float] | None:
    """
    Return what tilts a shader's surface: bumpmap or normalmap, its image, and how high it is [scene units].

    None where it is not as simple: an image over the UV map, in tangent space and of its full strength.
    """
    socket = None if node is None else node.inputs.get("Normal")
    if socket is None or not socket.is_linked:
        return None
    tilting = socket.links[0].from_node
    if tilting.type == "BUMP" and not tilting.inputs["Normal"].is_linked and not tilting.invert:
        image = image_of(tilting, "Height")
        strength, distance = (tilting.inputs[name].default_value for name in ("Strength", "Distance"))
        return None if image is None else ("bumpmap", image, strength * distance)
    if (
        tilting.type != "NORMAL_MAP"
        or tilting.space != "TANGENT"
        or tilting.inputs["Strength"].default_value != 1
    ):
        return None
    image = image_of(tilting, "Color")
    return None if image is None else ("normalmap", image, 0.0)


def opacity_of(node) -> float:
    """Return the part of the light that meets a shader's surface."""
    socket = None if node is None else node.inputs.get("Alpha")
    return 1.0 if socket is None or socket.is_linked else min(float(socket.default_value), 1.0)


def image_of(node, name: str):
    """Return the image that fills in a node's input, over the UV map, or None where it is not as simple."""
    socket = next((each for each in node.inputs if each.name.lower() == name.lower()), None)
    if socket is None or not socket.is_linked:
        return None
    source = socket.links[0].from_node
    return source.image if source.type == "TEX_IMAGE" and not source.inputs["Vector"].is_linked else None


def is_black(world) -> bool:
    """Return whether Blender's world sends out no light."""
    if not has_nodes(world):
        return max(world.color) <= 0
    node = surface_node(world.node_tree)
    if node is None:
        return True
    if node.type != "BACKGROUND" or any(socket.is_linked for socket in node.inputs):
        return False
    dark = max(_three(node.inputs["Color"].default_value)) <= 0
    return dark or node.inputs["Strength"].default_value <= 0


def _three(colour) -> tuple[float, float, float]:
    red, green, blue = list(colour)[:3]
    return red, green, blue
