"""
Every old recipe whose parent scene is there: each condition renders, or says what is missing.

The table says what a condition needs that may be missing: files that nobody has, or features, by the names of
the table of what each renderer can do. What is missing is said in one sentence, or in a warning where
something else was taken for it; what is not missing renders without a word about it.
"""

from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from rtb_addon import SceneBuilder, Spectrum
from rtb_addon.batch.rendering import render_condition
from rtb_addon.errors import RecipeError
from rtb_addon.old_recipes import import_recipe
from rtb_addon.renderers.fidelity import fidelity
from rtb_addon.scene.build import Placement
from rtb_addon.spectra import sources
from rtb_addon.spectra.files import read_spd, spd_text
from tests.renderings.old_files import RENDERERS, RTB3, RTB4, old

SMALL = {"width": 32, "height": 24, "samples": 2}
NEVER = "never"  # a feature that no renderer can have: what is missing is a file or a name


class Needed(NamedTuple):
    """
    Something that a condition needs.

    Parameters
    ----------
    feature : as the table of fidelity calls it, or NEVER
    words : in the sentence that says that it is missing
    """

    feature: str
    words: str


class Old(NamedTuple):
    """
    An old recipe.

    Parameters
    ----------
    parent, conditions, mappings : below the folders of RenderToolbox3 or 4; empty: none
    needed : by all conditions, or by the name of one
    made : files that the recipe's script wrote, or pictures whose licence keeps them away
    table : text of a conditions file that the recipe's script wrote
    """

    parent: str
    conditions: str = ""
    mappings: str = ""
    needed: dict[str, tuple[Needed, ...]] = {}
    made: tuple[str, ...] = ()
    table: str = ""


def below(folder, *names):
    """Return paths in a folder of example scenes; an empty name stays empty."""
    return tuple(name and f"ExampleScenes/{folder}/{name}" for name in names)


EVERY = "every condition"
EARTH = "earthbump1k-stretch-rgb.exr"
DAYLIGHTS = ("CIE-daylight-4000.spd", "CIE-daylight-10000.spd")
TARGETS = ("SpectralIllusionTarget.spd", "SpectralIllusionDestination.spd")
RECOVERED = "recovered-old-versions/ExampleScenes"

GLOSS = {
    "materialSphereWard": (Needed("material anisoward", "anisoward"),),
    "materialSphereMetal": (Needed("material metal", "metal"),),
}
NO_EARTH = {EVERY: (Needed(NEVER, EARTH),)}
BUMPS = {EVERY: (Needed("material bumpmap", "bumpmap"),), **GLOSS}
BLURRED = (Needed("filter gaussian", "the reconstruction filter is gaussian"),)
# Of filters there is one width each.
LENS = {EVERY: BLURRED, "2xFilter": (Needed(NEVER, "stddev of the filter gaussian is 1, only 0.5 is known"),)}
# The old scene's camera has a perspective, which these mappings make parallel.
WARD = {EVERY: (Needed("material anisoward", "anisoward"), Needed(NEVER, "orthographic"))}
NO_DAYLIGHT = {EVERY: (Needed(NEVER, DAYLIGHTS[0]),)}

SPHERE = below("MaterialSphere", "MaterialSphere.dae", "MaterialSphereConditions.txt")
SCALING = below("ScalingTest", "ScalingTest.dae", "ScalingTestConditions.txt")
SQUARE = below("SimpleSquare", "SimpleSquare.dae", "SimpleSquareConditions.txt")
OLD_SPHERE = f"{RECOVERED}/SimpleSphere/SimpleSphere.dae"
ILLUSION = f"{RECOVERED}/SpectralIllusion/SpectralIllusion.dae"
FIRST, SECOND, ILLUSIONS, ILLUSIONS_JSON = below(
    "SpectralIllusion",
    "SpectralIllusionConditionsInitial.txt",
    "SpectralIllusionConditionsClever.txt",
    "SpectralIllusionMappings.txt",
    "SpectralIllusionMappings.json",
)

OLDS = {
    "ColladaTexture": Old(
        *below("ColladaTexture", "ColladaTexture.dae"),
        needed={EVERY: (Needed("texture", "texture"), Needed(NEVER, EARTH))},
    ),
    "CoordinatesTest": Old(*below("CoordinatesTest", "CoordinatesTest.dae")),
    "CoordinatesTest of RenderToolbox4": Old("Test/Automated/Fixture/CoordinatesTest.dae"),
    "MaterialSphere": Old(*SPHERE, *below("MaterialSphere", "MaterialSphereMappings.txt"), GLOSS),
    "MaterialSphere as JSON": Old(*SPHERE, *below("MaterialSphere", "MaterialSphereMappings.json"), GLOSS),
    "MaterialSphereBumps": Old(
        *SPHERE, *below("MaterialSphere", "MaterialSphereBumpsMappings.txt"), NO_EARTH
    ),
    "MaterialSphereBumps with a picture": Old(
        *SPHERE, *below("MaterialSphere", "MaterialSphereBumpsMappings.txt"), BUMPS, (EARTH,)
    ),
    "MaterialSphereBumps as JSON": Old(
        *SPHERE, *below("MaterialSphere", "MaterialSphereBumpsMappings.json"), BUMPS, (EARTH,)
    ),
    "RadianceTest": Old(
        *below("RadianceTest", "RadianceTest.dae", "RadianceTestConditions.txt", "RadianceTestMappings.txt")
    ),
    "RadianceTest as JSON": Old(
        *below("RadianceTest", "RadianceTest.dae", "RadianceTestConditions.txt", "RadianceTestMappings.json")
    ),
    "ScalingTest": Old(*SCALING, *below("ScalingTest", "ScalingTestMappings.txt"), LENS),
    "ScalingTest as JSON": Old(*SCALING, *below("ScalingTest", "ScalingTestMappings.json"), LENS),
    "SceneFromScratch": Old(
        *below("SceneFromScratch", "rtbSceneFromScratch.dae", "", "rtbScratchMappings.json"),
        needed={EVERY: (Needed(NEVER, "stone_wall.exr"), Needed("texture", "texture"))},
    ),
    # Its last parent scene is lost; the lamp of this older one had another name.
    "SimpleSphere": Old(
        OLD_SPHERE,
        "",
        *below("SimpleSphere", "SimpleSphereMappings.txt"),
        {EVERY: (Needed(NEVER, "Lamp-light"),)},
    ),
    "SimpleSphere as JSON": Old(OLD_SPHERE, "", *below("SimpleSphere", "SimpleSphereMappings.json"), WARD),
    "SimpleSquare": Old(*SQUARE, *below("SimpleSquare", "SimpleSquareMappings.txt")),
    "SimpleSquare as JSON": Old(*SQUARE, *below("SimpleSquare", "SimpleSquareMappings.json")),
    "SpectralIllusion without its script": Old(ILLUSION, FIRST, ILLUSIONS, NO_DAYLIGHT),
    "SpectralIllusion, first pass": Old(ILLUSION, FIRST, ILLUSIONS, made=DAYLIGHTS + TARGETS),
    "SpectralIllusion, second pass": Old(ILLUSION, SECOND, ILLUSIONS, made=DAYLIGHTS + TARGETS),
    "SpectralIllusion as JSON": Old(ILLUSION, FIRST, ILLUSIONS_JSON, made=DAYLIGHTS + TARGETS),
    "SpectralPromotion": Old(
        "Utilities/SpectralPromotion/SpectralPromotion.dae",
        "",
        "Utilities/SpectralPromotion/SpectralPromotionMappings.txt",
        {EVERY: (Needed("native materials", "Reflector-material:bsdf:diffuse"),)},
        table="imageName\tilluminant\treflectanceRGB\ngray\tD65.spd\t0.5 0.5 0.5\n",
    ),
}

OUR_TABLE = """\
imageName	groupName	paint
plain	none	300:0.5
lightest	none	mccBabel-4.spd
longer	path	300:0.5
gloss	ward	300:0.5
lens	lens	300:0.5
lost	none	lost.spd
"""
OUR_MAPPINGS = """\
Collada {
    Camera:scale|sid=scale = -1 1 1
}
Generic {
    Paint-material:material:matte
    Paint-material:diffuseReflectance.spectrum = (paint)
}
Generic ward {
    Paint-material:material:anisoward
}
PBRT {
    integrator:SurfaceIntegrator:directlighting
    Paint-material:Material:plastic
}
Mitsuba path {
    integrator:integrator:path
    integrator:maxDepth.integer = 4
    Camera-camera_sampler:sampler:ldsampler
    Paint-material:ensureEnergyConservation.boolean = false
}
Mitsuba-path lens {
    Camera-camera.type = thinlens
    Camera-camera:float|name=apertureRadius.value = 0.1
}
"""
OUR_NEEDS = {
    "gloss": (Needed("material anisoward", "anisoward"),),
    "lens": (Needed("lens thin", "has a lens of some width"),),
    "lost": (Needed(NEVER, "there is no spectrum file lost.spd"),),
}

# Their parent scenes are lost, or were never anybody's to give.
WITHOUT_PARENT = {"BlenderPython", "Dice", "Dragon", "Interior"}


@pytest.fixture
def imported(request, tmp_path):
    """An old recipe's folder."""
    case: Old = OLDS[request.param]
    for name in case.made:
        (tmp_path / name).write_bytes(made(name))
    fourth = case.mappings.endswith(".json")
    parent, conditions, mappings = (found(name, fourth) if name else None for name in case[:3])
    if case.table:
        conditions = tmp_path / "conditions.txt"
        conditions.write_text(case.table)
    assert parent is not None
    recipe, _ = import_recipe(
        parent, conditions, mappings, tmp_path / "recipe", data=[RTB3 / "RenderData", tmp_path]
    )
    return recipe, case


def found(name: str, fourth: bool) -> Path:
    """Return a file of RenderToolbox3, or of RenderToolbox4, else of the other."""
    first, second = (RTB4, RTB3) if fourth else (RTB3, RTB4)
    return old(name, at=first if (first / name).exists() else second)


def made(name: str) -> bytes:
    """Return a file as a recipe's script wrote it; for a picture any other."""
    if name == EARTH:
        return old("ExampleScenes", "Dice", "DiceUVColored.exr").read_bytes()
    target = read_spd(old("RenderData", "Macbeth-ColorChecker", "mccBabel-11.spd"))
    spectra: dict[str, Spectrum] = {
        DAYLIGHTS[0]: sources.daylight(4000),
        DAYLIGHTS[1]: sources.daylight(10000).scaled(0.001),
        TARGETS[0]: target,
        TARGETS[1]: target.scaled(2),
    }
    return spd_text(spectra[name]).encode()


@pytest.mark.parametrize("renderer", RENDERERS)
@pytest.mark.parametrize("imported", OLDS, indirect=True)
def test_every_condition_renders_or_says_what_is_missing(imported, renderer):
    recipe, case = imported
    check_all(recipe, case.needed, renderer)


@pytest.mark.parametrize("renderer", RENDERERS)
def test_every_condition_of_ours_renders_or_says_what_is_missing(tmp_path, renderer):
    """The same for a scene of ours with blocks as the old ones have them."""
    scene = SceneBuilder("Wall")
    scene.plane("Wall", 2, 2, "Paint")
    scene.point("Lamp", placement=Placement((1, 1, 2)))
    scene.camera(placement=Placement((0, 0, 3)))
    for name, content in (("Wall.dae", scene.tobytes()), ("C.txt", OUR_TABLE), ("M.txt", OUR_MAPPINGS)):
        (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    recipe, _ = import_recipe(
        *(tmp_path / name for name in ("Wall.dae", "C.txt", "M.txt")), tmp_path / "ours"
    )
    check_all(recipe, OUR_NEEDS, renderer)


def check_all(recipe, needs, renderer):
    """Render every condition; what fails must have been foreseen by check, and nothing else."""
    recipe = recipe.overridden(renderer=renderer, **SMALL)
    foreseen = {str(problem) for problem in recipe.problems()}
    failed = set()
    for condition in recipe.conditions:
        needed = (*needs.get(EVERY, ()), *needs.get(condition.name, ()))
        missing = [each for each in needed if fidelity(renderer, each.feature).level == "absent"]
        sentences = outcome(recipe, condition.name)
        assert bool(sentences) == bool(missing), f"{condition.name}: {sentences}, expected {missing}"
        assert not missing or any(each.words in sentences for each in missing), sentences
        failed |= {sentences} if not recipe.rendering_file(condition).is_file() else set()
    assert failed <= foreseen
    assert bool(failed) == bool(foreseen)


def outcome(recipe, name):
    """Return the one sentence that a condition ends in, or what its warnings say was taken for another."""
    try:
        made = render_condition(recipe, name, lambda fraction: None)
    except RecipeError as error:
        sentence = str(error)
        assert sentence.count("\n") == 0
        assert not sentence.endswith(".")
        return sentence
    radiance = made.image.radiance
    assert np.isfinite(radiance).all()
    assert radiance.min() >= 0
    assert radiance.max() > 0
    return "\n".join(each for each in made.record["warnings"] if "texture" in each or "picture" in each)


def test_no_parent_scene_and_no_mappings_are_forgotten():
    old("ExampleScenes")
    old("ExampleScenes", at=RTB4)
    files = {
        path.relative_to(root).as_posix(): path.parent.name
        for root in (RTB3, RTB4)
        for end in ("*.dae", "*Mappings.txt", "*Mappings.json", "*Conditions*.txt")
        for path in root.rglob(end)
        if path.parent.name not in {*WITHOUT_PARENT, "RenderData"} and "gh-pages" not in path.parts
    }
    used = {name for case in OLDS.values() for name in case[:3]}
    of_tests = {name for name in files if name.startswith("Test/") and not name.endswith(".dae")}
    assert set(files) - used == of_tests
