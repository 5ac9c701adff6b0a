"""Blender's world: it sends out light only where it is tagged."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import RecipeError
from ..spectra import Unit
from .folders import typed
from .images import picture_of
from .nodes import has_nodes, is_black, surface_node
from .principled import in_words
from .statements import Picture, Spoken


@dataclass(frozen=True)
class Sky:
    """
    What comes from all around.

    Parameters
    ----------
    radiance : of every direction, or what a picture is multiplied by; None for sun and sky
    picture : an equirectangular one, as Blender's; None where all directions are alike
    rotation : of the picture around X, then Y, then Z [degrees]; it brings +Z to the sun
    turbidity : of the air below sun and sky
    """

    radiance: Spoken | None
    picture: Picture | None = None
    rotation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turbidity: float = 3.0

    @property
    def stands(self) -> bool:
        """Whether it is turned some way, and so has a place in the parent scene."""
        return self.picture is not None or self.radiance is None


def read_world(world) -> tuple[Sky | None, tuple[str, ...]]:
    """Return the radiance that comes from all around, if any does, and what had to be assumed."""
    if world is None:
        return None, ()
    settings, owner = world.rtb, f"the world {world.name_full}"
    if settings.use_spectra:
        return _tagged(world, settings, owner), ()
    if is_black(world):
        return None, ()
    return None, (f"{owner} has no spectrum and sends out no light, as if it were black",)


def _tagged(world, settings, owner: str) -> Sky:
    if settings.kind == "SUNSKY":
        from_zenith = 90 - math.degrees(settings.elevation)
        turned = (0.0, from_zenith, math.degrees(settings.azimuth))
        return Sky(None, rotation=turned, turbidity=settings.turbidity)
    text = typed(settings.spectrum, world)
    if settings.measure == "NITS":
        radiance = Spoken(text, owner, Unit.RADIANCE, 1.0, lumens=settings.amount)
    else:
        radiance = Spoken(text, owner, Unit.RADIANCE, settings.amount)
    if settings.kind == "CONSTANT":
        return Sky(radiance)
    if settings.measure == "NITS":
        raise RecipeError(
            f"{owner} is a picture, which has radiances and no one luminance: measure it as radiance"
        )
    if settings.image is None:
        raise RecipeError(f"{owner} is to show an image, choose one")
    x, y, z = (math.degrees(angle) for angle in settings.rotation)
    return Sky(radiance, picture_of(settings.image, owner), (x, y, z))


def promote_world(world) -> str:
    """Give a world what its nodes show, an image or an even light, and return the sentence that says how."""
    settings = world.rtb
    node = surface_node(world.node_tree) if has_nodes(world) else None
    if node is None or node.type != "BACKGROUND":
        return f"{world.name}: its nodes are not read, say its light here"
    settings.amount = node.inputs["Strength"].default_value
    if not node.inputs["Color"].is_linked:
        settings.spectrum = in_words(tuple(node.inputs["Color"].default_value)[:3])
        return f"{world.name}: its colour is promoted to a spectrum of radiance, its strength is the amount"
    source = node.inputs["Color"].links[0].from_node
    if source.type != "TEX_ENVIRONMENT" or source.image is None or source.projection != "EQUIRECTANGULAR":
        return f"{world.name}: its {source.bl_label.lower()} is not read, say its light here"
    settings.kind, settings.image, settings.spectrum = "IMAGE", source.image, "1"
    settings.rotation = _turned(source.inputs["Vector"])
    return f"{world.name}: its environment image, turned as its Mapping node turns it"


def _turned(socket):
    """Return how an image turns whose directions a Mapping node turns: the other way round."""
    from mathutils import Euler

    if not socket.is_linked or socket.links[0].from_node.type != "MAPPING":
        return (0.0, 0.0, 0.0)
    mapping = socket.links[0].from_node
    turned = Euler(mapping.inputs["Rotation"].default_value, "XYZ").to_matrix()
    return (turned if mapping.vector_type == "TEXTURE" else turned.inverted()).to_euler("XYZ")
