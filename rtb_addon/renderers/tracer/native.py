"""
The native scene of the tracer: one JSON file that a person can read, and meshes beside it.

It says what a RenderScene says, in the same words; numbers are written so that reading
gives back the same bits.
"""

from __future__ import annotations

import json
import os
from collections.abc import Collection, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ...errors import RecipeError, RenderingError
from ...files import write_text
from ...scene.render_scene import (
    Camera,
    Crop,
    Film,
    Integrator,
    Light,
    Material,
    Mesh,
    RenderScene,
    Shape,
    Texture,
    TextureUse,
    Value,
)
from ...spectra import Bands, Spectrum, Unit
from ..fidelity import unsupported
from ..interface import Extras
from ..native_lines import scene_with
from ..ply import read_mesh, write_mesh
from .checks import check

VERSION = 3
_FORMAT = "RenderToolbox tracer scene"
# The meshes of the last scene: their files are named by content.
_warm: dict[str, Mesh] = {}


def translate(scene: RenderScene, extras: Extras, folder: Path, name: str, renderer: str = "tracer") -> Path:
    """Write a scene as folder/NAME.json, its meshes in folder/meshes, and return that file."""
    scene = scene_with(scene, extras, renderer)
    if lacking := unsupported(scene, renderer):
        raise RecipeError(lacking[0])
    check(scene)
    path = folder / f"{name}.json"
    write_text(path, _text(_scene(scene, folder)) + "\n")
    return path


def read(path: Path) -> RenderScene:
    """Read a native scene, bit for bit as it was translated."""
    try:
        native = json.loads(path.read_text(encoding="utf-8"))
        if (native["format"], native["version"]) != (_FORMAT, VERSION):
            raise KeyError("format")
        return _read_scene(native, path.parent)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RenderingError(f"{path.name} cannot be read, translate the scene again ({error!r})") from error


def _scene(scene: RenderScene, folder: Path) -> dict[str, Any]:
    return {
        "format": _FORMAT,
        "version": VERSION,
        "integrator": asdict(scene.integrator),
        "film": _film(scene.film),
        "camera": {**asdict(scene.camera), "to_world": scene.camera.to_world.tolist()},
        "environment": None if scene.environment is None else _light(scene.environment, folder),
        "lights": [_light(light, folder) for light in scene.lights],
        "materials": [
            {
                "id": material.id,
                "model": material.model,
                "parameters": _parameters(material.parameters, folder),
            }
            for material in scene.materials.values()
        ],
        "textures": [_texture(texture, folder) for texture in scene.textures.values()],
        "shapes": [_shape(shape, folder) for shape in scene.shapes],
    }


def _film(film: Film) -> dict[str, Any]:
    bands = {"centres": film.bands.centres.tolist(), "edges": film.bands.edges.tolist()}
    return {
        "width": film.width,
        "height": film.height,
        "filter": film.filter,
        "crop": film.crop,
        "band_kind": film.band_kind,
        "bands": bands,
    }


def _light(light: Light, folder: Path) -> dict[str, Any]:
    parameters = _parameters(light.parameters, folder)
    return {"id": light.id, "kind": light.kind, "to_world": light.to_world.tolist(), "parameters": parameters}


def _shape(shape: Shape, folder: Path) -> dict[str, Any]:
    return {
        "id": shape.id,
        "mesh": write_mesh(shape.mesh, folder).relative_to(folder).as_posix(),
        "material": shape.material,
        "to_world": shape.to_world.tolist(),
        "emission": None if shape.emission is None else _spectrum(shape.emission),
    }


def _parameters(parameters: Mapping[str, Value], folder: Path) -> dict[str, Any]:
    """Return parameters, files named as seen from the native scene's folder."""
    said = {name: _value(value) for name, value in parameters.items()}
    if said.get("filename"):
        said["filename"] = Path(os.path.relpath(said["filename"], folder)).as_posix()
    return said


def _value(value: Value) -> Any:
    if isinstance(value, TextureUse):
        return {"texture": value.texture}
    return _spectrum(value) if isinstance(value, Spectrum) else value


def _texture(texture: Texture, folder: Path) -> dict[str, Any]:
    return {"id": texture.id, "kind": texture.kind, "parameters": _parameters(texture.parameters, folder)}


def _spectrum(spectrum: Spectrum) -> dict[str, Any]:
    pairs = np.stack([spectrum.wavelengths, spectrum.values], axis=1)
    return {"unit": spectrum.unit.value, "pairs": pairs.tolist()}


def _text(value: Any, indent: str = "") -> str:
    """Return JSON with a line for each thing that has a name, matrices and spectra on one line."""
    inner = indent + "  "
    if isinstance(value, dict) and value:
        lines = [f"{inner}{json.dumps(key)}: {_text(part, inner)}" for key, part in value.items()]
        return "{\n" + ",\n".join(lines) + f"\n{indent}}}"
    if isinstance(value, list) and any(isinstance(part, dict) for part in value):
        return "[\n" + ",\n".join(inner + _text(part, inner) for part in value) + f"\n{indent}]"
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _read_scene(native: dict[str, Any], folder: Path) -> RenderScene:
    camera, environment = native["camera"], native["environment"]
    materials = [
        Material(one["id"], one["model"], _read_parameters(one["parameters"], folder))
        for one in native["materials"]
    ]
    meshes = _read_meshes({one["mesh"] for one in native["shapes"]}, folder)
    return RenderScene(
        camera=Camera(
            camera["id"],
            camera["projection"],
            np.array(camera["to_world"], float),
            tuple(camera["window"]),
            tuple(camera["clip"]),
            camera["lens_radius"],
            camera["focus_distance"],
        ),
        shapes=tuple(_read_shape(one, meshes) for one in native["shapes"]),
        materials={material.id: material for material in materials},
        lights=tuple(_read_light(one, folder) for one in native["lights"]),
        textures={one["id"]: _read_texture(one, folder) for one in native["textures"]},
        environment=None if environment is None else _read_light(environment, folder),
        integrator=Integrator(**native["integrator"]),
        film=_read_film(native["film"]),
    )


def _read_meshes(names: Collection[str], folder: Path) -> Mapping[str, Mesh]:
    """Return meshes by the names of their files; those of the last scene are not read again."""
    found = {name: _warm.get(name) or read_mesh(folder / name) for name in names}
    _warm.clear()
    _warm.update(found)
    return found


def _read_film(one: dict[str, Any]) -> Film:
    bands = Bands(np.array(one["bands"]["centres"]), np.array(one["bands"]["edges"]))
    return Film(**{**one, "bands": bands, "crop": Crop(*one["crop"]) if one["crop"] else None})


def _read_light(one: dict[str, Any], folder: Path) -> Light:
    to_world = np.array(one["to_world"], float)
    return Light(one["id"], one["kind"], to_world, _read_parameters(one["parameters"], folder))


def _read_shape(one: dict[str, Any], meshes: Mapping[str, Mesh]) -> Shape:
    emission = None if one["emission"] is None else _read_spectrum(one["emission"])
    to_world = np.array(one["to_world"], float)
    return Shape(one["id"], meshes[one["mesh"]], to_world, one["material"], emission)


def _read_parameters(parameters: dict[str, Any], folder: Path) -> dict[str, Value]:
    said = {name: _read_value(value) for name, value in parameters.items()}
    if said.get("filename"):
        said["filename"] = os.path.normpath(folder / str(said["filename"]))
    return said


def _read_value(value: Any) -> Value:
    if not isinstance(value, dict):
        return value
    return TextureUse(value["texture"]) if "texture" in value else _read_spectrum(value)


def _read_texture(one: dict[str, Any], folder: Path) -> Texture:
    return Texture(one["id"], one["kind"], _read_parameters(one["parameters"], folder))


def _read_spectrum(one: dict[str, Any]) -> Spectrum:
    wavelengths, values = np.array(one["pairs"], float).T
    return Spectrum.of(wavelengths, values, Unit(one["unit"]))
