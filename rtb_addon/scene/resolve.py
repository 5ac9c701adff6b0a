"""A parent scene and one condition's mappings made into the neutral scene that renderers see."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal, NamedTuple

from ..errors import RecipeError, at, choices
from ..spectra import Spectrum
from .adjustments import Adjustments, NativeLine
from .collada.cameras import read_camera
from .collada.left_out import left_out
from .collada.nodes import Instance, instances, metres_per_unit
from .declarations import declarations
from .document import Scene
from .render_scene import Camera, Film, Integrator, Light, RenderScene, Shape
from .resolve_lights import Lights, lights_of
from .resolve_materials import Materials
from .resolve_shapes import shapes_of
from .values import Values


@dataclass(frozen=True)
class SceneSettings:
    """
    What a recipe says about a scene outside of its mappings.

    Parameters
    ----------
    camera : id of a camera or of its node; empty for the first camera of the scene
    handedness : rtb3 where the camera's X axis points left, so that old mappings mirror it back
    """

    film: Film = field(default_factory=Film)
    integrator: Integrator = field(default_factory=Integrator)
    camera: str = ""
    handedness: Literal["blender", "rtb3"] = "blender"


class Resolved(NamedTuple):
    """
    A condition's scene.

    Parameters
    ----------
    scene : what every renderer sees
    extras : lines for the one renderer alone
    warnings : what was odd or had to be assumed, a sentence each
    """

    scene: RenderScene
    extras: tuple[NativeLine, ...]
    warnings: tuple[str, ...]


def resolve(
    document: Scene,
    adjustments: Adjustments,
    settings: SceneSettings,
    find_file: Callable[[str], Path | None],
) -> Resolved:
    """
    Return the neutral scene of one condition, in metres with Z up.

    Parameters
    ----------
    document : the parent scene, before or after adjusting
    find_file : returns the recipe's file of a name, or None
    """
    document = document.adjusted(adjustments)
    values = Values(find_file)
    placed = list(instances(document))
    declared = declarations(adjustments.objects, values)
    native = frozenset(line.text.partition(":")[0] for line in adjustments.native)
    materials = Materials(document, declared, values, native)
    lights = lights_of(document, placed, declared, values)
    meshes = [each for each in placed if each.kind == "geometry"]
    shapes = list(shapes_of(document, meshes, materials, lights.emissions))
    shapes, lights = _lit(shapes, lights, document, values)
    scene = RenderScene(
        camera=_camera(document, placed, settings),
        shapes=tuple(shapes),
        materials=materials.made,
        lights=tuple(lights.lamps),
        textures=materials.textures,
        environment=lights.environment,
        integrator=settings.integrator,
        film=settings.film,
    )
    remarks = map(str, (*adjustments.remarks, *document.remarks, *materials.unused()))
    warnings = (*remarks, *left_out(document), *_controllers(placed), *values.warnings)
    return Resolved(scene, adjustments.native, tuple(dict.fromkeys(warnings)))


def _controllers(placed: list[Instance]) -> Iterator[str]:
    for one in placed:
        if one.kind == "controller":
            yield f"{one.name} follows a skeleton or morph and is left out"


def _camera(document: Scene, placed: list[Instance], settings: SceneSettings) -> Camera:
    cameras = [each for each in placed if each.kind == "camera"]
    if not cameras:
        raise RecipeError("the scene has no camera, add one in the modeller", document.file)
    names = [(each.node.get("id"), each.thing.get("id"), each.node.get("name")) for each in cameras]
    chosen = [
        one
        for one, known in zip(cameras, names, strict=True)
        if not settings.camera or settings.camera in known
    ]
    if not chosen:
        there = choices(settings.camera, (known[0] or known[1] for known in names))
        raise RecipeError(f"no camera is called {settings.camera}, there are {there}", document.file)
    camera, unit = chosen[0], metres_per_unit(document)
    with at(document.file, document.line_of(camera.thing)):
        mirrored = settings.handedness == "rtb3"
        id = camera.node.get("id") or camera.thing.get("id")
        return read_camera(camera.thing, id, camera.to_world, unit, settings.film, mirrored)


def _lit(shapes: list[Shape], lights: Lights, document: Scene, values: Values) -> tuple[list[Shape], Lights]:
    """Return shapes and lights without those that are off; raise where nothing could shine."""
    emitting = [each for each in shapes if each.emission is not None]
    if not (lights.lamps or emitting or lights.environment):
        message = "the scene has no light, add a lamp or declare a mesh an area light (X-mesh:light:area)"
        raise RecipeError(message, document.file)
    lamps = [each for each in lights.lamps if _is_on(each)]
    dark = [
        replace(each, emission=None) if each.emission and not each.emission.values.any() else each
        for each in shapes
    ]
    if lamps or lights.environment or any(each.emission for each in dark):
        return dark, Lights(lamps, lights.emissions, lights.environment)
    values.warnings.append("every light is off in this condition, its picture will be black")
    return shapes, lights


def _is_on(lamp: Light) -> bool:
    intensity = lamp.parameters.get("intensity")
    return not isinstance(intensity, Spectrum) or bool(intensity.values.any())
