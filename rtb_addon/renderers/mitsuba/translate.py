"""
A RenderScene as stock Mitsuba 3 XML.

Plain Mitsuba loads and renders it in its spectral variants: path integrator, specfilm with one unit-integral
band per channel, spectra as tables. What stock Mitsuba has no word for stands in ``<default>`` elements,
which it reads and ignores, and a comment says so; our own renderer reads them (see native.py).
"""

from __future__ import annotations

import os
from pathlib import Path
from xml.etree import ElementTree as Xml

import numpy as np

from ...errors import RecipeError
from ...files import write_bytes
from ...scene.render_scene import Integrator, Mesh, RenderScene, Shape
from ..interface import Extras
from ..native_lines import scene_with
from ..ply import write_mesh
from .xml.called import called
from .xml.camera import matrix, sensor
from .xml.environment import environment
from .xml.film import band_defaults, film
from .xml.lights import BLACK, light
from .xml.materials import materials, texture_of
from .xml.names import Names
from .xml.spectrum import element, format_spectrum, range_for


def translate(scene: RenderScene, extras: Extras, folder: Path, name: str) -> Path:
    """Write NAME.xml and the meshes it names into a folder, and return the XML file."""
    path = folder / f"{name}.xml"
    root = scene_xml(scene_with(scene, extras, "Mitsuba"), folder)
    Xml.indent(root)
    write_bytes(path, Xml.tostring(root, encoding="utf-8", xml_declaration=True))
    return path


def scene_xml(scene: RenderScene, folder: Path) -> Xml.Element:
    """Return the scene as an element; writes the meshes into the folder."""
    integrator = scene.integrator
    if integrator.depth < 1 or integrator.samples < 1:
        raise RecipeError(
            f"depth {integrator.depth} and {integrator.samples} samples, give 1 or more of each"
        )
    span, names = range_for(scene.film.bands), Names()
    root = Xml.Element("scene", version="3.0.0")
    root.extend(band_defaults(scene.film))
    root.append(_integrator(integrator))
    root.append(_black(names))
    root.extend(sensor(scene.camera, scene.film, _sampler(integrator), film(scene.film), names))
    root.extend(materials(scene, names, span, folder))
    for shape in scene.shapes:
        if len(shape.mesh.triangles):
            _check_uvs(shape, scene)
            root.append(_shape(shape, folder, names, span))
    for lamp in scene.lights:
        root.extend(light(lamp, names, span))
    if scene.environment is not None:
        root.extend(environment(scene.environment, names, span, folder))
    root.extend(called(scene, names))
    return root


def _integrator(integrator: Integrator) -> Xml.Element:
    depth = min(integrator.depth, 2) if integrator.kind == "direct" else integrator.depth
    # Stock Mitsuba's roulette looks at the spectra, ours does not. Without any, its depth is never met.
    return element("integrator", "path", max_depth=depth, rr_depth=integrator.roulette or depth + 1)


def _sampler(integrator: Integrator) -> Xml.Element:
    return element("sampler", "multijitter", sample_count=integrator.samples, seed=integrator.seed % 2**31)


def _black(names: Names) -> Xml.Element:
    node = element("bsdf", "diffuse", id=names.of("material", BLACK))
    node.append(element("spectrum", "uniform", name="reflectance", value=0.0))
    return node


def _check_uvs(shape: Shape, scene: RenderScene) -> None:
    """Refuse a texture on a mesh that does not say where each of its points lies in it."""
    if shape.mesh.uvs is None and (found := texture_of(shape.material, scene)):
        raise RecipeError(f"shape {shape.id} has texture {found} but no texture coordinates, unwrap its mesh")


def _shape(shape: Shape, folder: Path, names: Names, span: tuple[float, float]) -> Xml.Element:
    emits = shape.emission is not None and shape.emission.values.any()
    mesh, place = _turned(shape.mesh, shape.to_world), names.of("shape", shape.id)
    file = write_mesh(mesh, folder)
    # Emission leaves by the triangles' own normals; Mitsuba would take the smooth ones.
    flat = bool(mesh.normals is None or emits)
    node = element(
        "shape", "ply", id=place, filename=Path(os.path.relpath(file, folder)).as_posix(), face_normals=flat
    )
    node.append(matrix("to_world", shape.to_world))
    node.append(Xml.Element("ref", id=names.known("material", shape.material, f"shape {shape.id}")))
    if emits and shape.emission is not None:
        emitter = element("emitter", "area", id=names.of("emitter", f"{shape.id}-emission"))
        emitter.append(format_spectrum("radiance", shape.emission, span))
        node.append(emitter)
    return node


def _turned(mesh: Mesh, to_world: np.ndarray) -> Mesh:
    """Return the mesh, wound the other way if its matrix mirrors, so that its normals stay outside."""
    if np.linalg.det(to_world[:3, :3]) >= 0:
        return mesh
    return Mesh(mesh.vertices, np.ascontiguousarray(mesh.triangles[:, ::-1]), mesh.normals, mesh.uvs)
