"""Small parent scenes and what mappings make of them."""

import os
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.conditions import Conditions
from rtb_addon.mappings import parse_mappings
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.document import Scene
from rtb_addon.scene.render_scene import Film
from rtb_addon.scene.resolve import SceneSettings, resolve

RTB3 = Path(os.environ.get("RTB3_FOLDER", Path(__file__).resolve().parents[3] / "shared" / "rtb3"))

SETTINGS = SceneSettings(Film(320, 240))

DEFAULT_MAPPINGS = "Collada {\n    Camera:scale|sid=scale = -1 1 1\n}\n"


def nothing(name):
    return None


def old(*parts):
    file = RTB3.joinpath(*parts)
    if not file.exists():
        pytest.skip(f"RENDERTOOLBOX3'S FILES ARE NOT HERE: no {file}, set RTB3_FOLDER")
    return file


def in_folder(folder):
    return lambda name: folder / name if (folder / name).is_file() else None


def resolved(scene, mappings="", settings=SETTINGS, find_file=nothing, condition=None):
    document = Scene.parse(scene if isinstance(scene, bytes) else scene.tobytes(), "parent.dae")
    row = condition or next(iter(Conditions.single("one")))
    adjustments = parse_mappings(mappings, "mappings.txt").fill_in(row, "tracer", document, find_file)
    return resolve(document, adjustments, settings, find_file)


def generic(*lines):
    return "Generic {\n" + "\n".join(lines) + "\n}\n"


def room(camera=True, lamp=True):
    """Return a builder with a wall, a camera and a lamp."""
    builder = SceneBuilder()
    builder.plane("Wall", 2, 2, "Paint")
    if camera:
        builder.camera(placement=Placement((0, 0, 5)))
    if lamp:
        builder.point("Lamp", placement=Placement((0, 0, 3)))
    return builder


def with_nodes(nodes, unit="1", up="Z_UP", library=""):
    """Return a document of a room whose visual scene holds other nodes."""
    text = room().tobytes().decode()
    start, end = text.index("<node"), text.index("</visual_scene>")
    asset = text.index("<up_axis>")
    text = text[:start] + nodes + text[end:]
    text = text.replace("</library_geometries>", "</library_geometries>" + library)
    return (
        (text[:asset] + text[asset:].replace("Z_UP", up, 1)).replace('meter="1"', f'meter="{unit}"').encode()
    )


CAMERA = '<node id="Camera"><translate>0 0 5</translate><instance_camera url="#Camera-camera"/></node>'

LAMP = '<node id="Lamp"><instance_light url="#Lamp-light"/></node>'


def wall(transforms="", inside="", id="Wall"):
    return (
        f'<node id="{id}">{transforms}<instance_geometry url="#Wall-mesh"><bind_material><technique_common>'
        '<instance_material symbol="Paint-material" target="#Paint-material"/></technique_common>'
        f"</bind_material></instance_geometry>{inside}</node>"
    )


def wall_matrix(transforms, **document):
    scene = resolved(with_nodes(CAMERA + LAMP + wall(transforms), **document)).scene
    return scene.shapes[0].to_world


def world_area(shape):
    points = shape.mesh.vertices @ shape.to_world[:3, :3].T + shape.to_world[:3, 3]
    a, b, c = points[shape.mesh.triangles].transpose(1, 0, 2)
    return np.cross(b - a, c - a).sum(axis=0) / 2


def pixel_of(camera, film, point):
    """Return column and row [pixels] of a point in the world."""
    x, y, z, _ = np.linalg.inv(camera.to_world) @ [*point, 1]
    left, right, bottom, top = camera.window
    if camera.projection == "perspective":
        x, y = x / -z, y / -z
    return (x - left) / (right - left) * film.width, (top - y) / (top - bottom) * film.height
