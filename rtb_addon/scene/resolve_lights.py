"""The lights of a scene: lamps at their nodes, meshes that emit, the environment."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..errors import at, choices
from ..spectra import Spectrum, Unit
from ..spectra.promotion import promoted
from .collada.cameras import rigid
from .collada.colours import Lamp, read_lamp
from .collada.nodes import Instance
from .declarations import Declaration, parameters_of
from .document import Scene
from .render_scene import Light
from .values import Values
from .vocabulary import LIGHTS

_EVERYWHERE = ("environment", "sunsky")


@dataclass
class Lights:
    """
    The lights that a recipe declares and a document places.

    Attributes
    ----------
    lamps : lamps without a mesh
    emissions : radiance of the geometries that emit, by id
    environment : what comes from every direction, if anything does
    """

    lamps: list[Light] = field(default_factory=list)
    emissions: dict[str, Spectrum] = field(default_factory=dict)
    environment: Light | None = None


def lights_of(
    document: Scene, placed: list[Instance], declared: Mapping[str, Declaration], values: Values
) -> Lights:
    """Return the lights; a declared one that stands nowhere raises."""
    lights = Lights()
    for instance in placed:
        if instance.kind == "light":
            lamp = _lamp(document, instance, declared.get(instance.thing.get("id")), values)
            if lamp is not None:
                lights.lamps.append(_named_once(lamp, lights.lamps))
    for each in declared.values():
        if each.category == "light":
            _add_declared(each, document, placed, values, lights)
    return lights


def _lamp(document: Scene, instance: Instance, declared: Declaration | None, values: Values) -> Light | None:
    id = instance.thing.get("id")
    with at(document.file, document.line_of(instance.thing)):
        lamp = read_lamp(instance.thing)
        to_world = rigid(instance.to_world)
        if np.linalg.det(to_world[:3, :3]) < 0:
            to_world[:3, 0] *= -1
    if declared is None:
        return _promoted(id, lamp, to_world, values)
    if declared.category != "light":
        raise declared.error(f"{id} is a light of the parent scene, declare it a light")
    if declared.model == "area":
        raise declared.error(
            f"{id} is a lamp, declare the mesh that emits: {id.removesuffix('-light')}-mesh:light:area"
        )
    if declared.model in _EVERYWHERE:
        return None
    return Light(id, declared.model, to_world, parameters_of(declared, values, lamp.numbers))


def _promoted(id: str, lamp: Lamp, to_world: np.ndarray, values: Values) -> Light | None:
    if lamp.kind == "ambient":
        values.warnings.append(
            f"{id} is an ambient light and left out, declare it directional to have it as RenderToolbox3 had"
        )
        return None
    parameters = {name: each.default_value() for name, each in LIGHTS[lamp.kind].items()}
    unit = Unit(LIGHTS[lamp.kind]["intensity"].unit)
    shown = " ".join(f"{each:.4g}" for each in lamp.colour)
    values.warnings.append(f"{id} has no mapping: its colour {shown} was promoted to its intensity [{unit}]")
    chosen = {**parameters, **lamp.numbers, "intensity": promoted(lamp.colour, unit)}
    return Light(id, lamp.kind, to_world, {name: each for name, each in chosen.items() if each is not None})


def _add_declared(
    each: Declaration, document: Scene, placed: list[Instance], values: Values, lights: Lights
) -> None:
    if each.model in _EVERYWHERE:
        if lights.environment is not None:
            raise each.error(f"{each.id} is a second environment, beside {lights.environment.id}")
        node = next((one for one in placed if one.thing.get("id") == each.id), None)
        to_world = np.eye(4) if node is None else rigid(node.to_world)
        lights.environment = Light(each.id, each.model, to_world, parameters_of(each, values))
        return
    kind = "geometry" if each.model == "area" else "light"
    if not any(one.kind == kind and one.thing.get("id") == each.id for one in placed):
        what = "mesh" if kind == "geometry" else "light"
        there = choices(each.id, (one.thing.get("id") for one in placed if one.kind == kind))
        raise each.error(f"no {what} in the scene has the id {each.id}, there are {there}")
    if kind == "geometry":
        intensity = parameters_of(each, values)["intensity"]
        assert isinstance(intensity, Spectrum)
        lights.emissions[each.id] = intensity


def _named_once(lamp: Light, others: list[Light]) -> Light:
    """Return a lamp with a number behind its id where other nodes hold the same lamp."""
    same = sum(each.id == lamp.id or each.id.startswith(f"{lamp.id}_") for each in others)
    return Light(f"{lamp.id}_{same}", lamp.kind, lamp.to_world, lamp.parameters) if same else lamp
