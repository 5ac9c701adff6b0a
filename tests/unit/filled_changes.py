"""Mappings of RenderToolbox4 for a small room."""

import json
import os
from pathlib import Path

from rtb_addon.conditions import Condition
from rtb_addon.mappings import parse_mappings
from rtb_addon.scene.build import Placement, SceneBuilder
from rtb_addon.scene.document import Scene

SHARED = Path(__file__).resolve().parents[3] / "shared"

RTB4 = Path(os.environ.get("RTB4_FOLDER", SHARED / "rtb4"))

# Changes and properties of the files that RenderToolbox4 shipped, counted with plain JSON.
OLD_FILES = {
    "ExampleScenes/BlenderPython/CheckerShadowSceneMappings.json": (11, 30),
    "ExampleScenes/Dice/DiceMappings.json": (5, 6),
    "ExampleScenes/Dice/DiceTransformationsMappings.json": (8, 9),
    "ExampleScenes/Dragon/DragonColorCheckerMappings.json": (6, 6),
    "ExampleScenes/Dragon/DragonGradedMappings.json": (6, 6),
    "ExampleScenes/Dragon/DragonMappings.json": (6, 6),
    "ExampleScenes/Dragon/DragonMaterialsMappings.json": (12, 17),
    "ExampleScenes/Interior/InteriorMappings.json": (39, 41),
    "ExampleScenes/MaterialSphere/MaterialSphereBumpsMappings.json": (6, 11),
    "ExampleScenes/MaterialSphere/MaterialSphereMappings.json": (4, 8),
    "ExampleScenes/RadianceTest/RadianceTestMappings.json": (10, 10),
    "ExampleScenes/ScalingTest/ScalingTestMappings.json": (8, 16),
    "ExampleScenes/SceneFromScratch/rtbScratchMappings.json": (5, 5),
    "ExampleScenes/SimpleSphere/SimpleSphereMappings.json": (7, 11),
    "ExampleScenes/SimpleSquare/SimpleSquareMappings.json": (2, 2),
    "ExampleScenes/SpectralIllusion/SpectralIllusionMappings.json": (33, 32),
    "Test/Automated/Fixture/DragonColorCheckerMappings.json": (6, 6),
}


def room():
    builder = SceneBuilder()
    builder.plane("Wall", 2, 2, "Paint")
    builder.plane("Panel", 1, 1, "Black", Placement((0, 0, 9), (180, 0, 0)))
    builder.camera(placement=Placement((0, 0, 5)))
    builder.point("Lamp", placement=Placement((0, 0, 3)))
    builder.spot("Beam", cone=60.0, placement=Placement((1, 0, 3)))
    return Scene.parse(builder.tobytes(), "parent.dae")


def nothing(name):
    return None


def filled(*changes, renderer="mitsuba", find_file=nothing, scene=None, **cells):
    mappings = parse_mappings(json.dumps(changes, indent=1), "mappings.json")
    return mappings.fill_in(Condition("first", cells), renderer, scene or room(), find_file)


def said(adjustments):
    return [
        (each.id, each.category, each.model, {p.name: p.value for p in each.properties})
        for each in adjustments.objects
    ]


def update(name, kind, model="", destination="Generic", **properties):
    words = {"name": name, "broadType": kind, "operation": "update", "destination": destination}
    listed = [{"name": key, "value": value} for key, value in properties.items()]
    return {**words, "specificType": model, "properties": listed}


def moved(name, operation):
    properties = {"name": "transformation", "operation": operation}
    words = {"name": name, "broadType": "nodes", "operation": "update", "destination": "mexximp"}
    return {**words, "properties": properties}
