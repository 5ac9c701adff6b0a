"""The tracer's native scene: what is written is read, and what cannot be rendered is said."""

import ast
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from rtb_addon.errors import RecipeError, RenderingError
from rtb_addon.renderers import fidelity, find
from rtb_addon.renderers.interface import NativeLine, RenderOptions
from rtb_addon.renderers.tracer import native
from rtb_addon.renderers.tracer.sampler import Sampler, sequence
from rtb_addon.scene.render_scene import (
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
)
from rtb_addon.spectra import Bands, Spectrum, Unit

ROOM = Path(native.__file__).parent


def awkward(rng, *shape):
    """Return numbers with all their digits."""
    return rng.normal(size=shape) * 10.0 ** rng.integers(-30, 30, shape)


@pytest.fixture
def full():
    """Return a scene that holds one of everything."""
    rng = np.random.default_rng(0)
    floats = rng.normal(size=(5, 3)).astype(np.float32)
    mesh = Mesh(floats, np.array([[0, 1, 2], [2, 3, 4]], np.int32), floats, floats[:, :2].copy())
    paint = Spectrum.of(np.sort(rng.uniform(300, 800, 9)), rng.random(9))
    light = {"intensity": Spectrum.of([400, 500.1], [1 / 3, 2e-17], Unit.INTENSITY)}
    return RenderScene(
        Camera(
            "Camera-camera", "perspective", awkward(rng, 4, 4), tuple(awkward(rng, 4).tolist()), (0.1, 1e5)
        ),
        (
            Shape("Vase-mesh", mesh, awkward(rng, 4, 4), "Paint"),
            Shape(
                "Glow-mesh",
                replace(mesh, normals=None),
                np.eye(4),
                "Grün",
                Spectrum.constant(0.1, Unit.RADIANCE),
            ),
        ),
        {
            "Paint": Material("Paint", "matte", {"diffuseReflectance": TextureUse("Board")}),
            "Grün": Material("Grün", "matte", {"diffuseReflectance": paint}),
        },
        (
            Light("Lamp-light", "point", awkward(rng, 4, 4), {**light, "radius": 0.1}),
            Light("Spot-light", "spot", np.eye(4), {**light, "radius": 0.0, "cone": 45.0, "blend": 1 / 7}),
        ),
        textures={
            "Board": Texture(
                "Board", "checkerboard", {"oddColor": paint, "evenColor": paint, "checksPerU": 1 / 3}
            ),
            "Wall": Texture("Wall", "bitmap", {"filename": "/pictures/stone.exr", "wrapMode": "repeat"}),
        },
        environment=Light("World", "environment", np.eye(4), {**light, "filename": ""}),
        integrator=Integrator("path", 7, 12, 3),
        film=Film(32, 24, Bands.around([400, 433.3, 500]), "centre", "mitchell", Crop(1, 2, 30, 20)),
    )


def same(one, other):
    """Return whether two values of a scene are the same to the last bit."""
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other)
    if isinstance(one, dict):
        return list(one) == list(other) and all(same(one[key], other[key]) for key in one)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if hasattr(one, "__dataclass_fields__"):
        return all(same(getattr(one, name), getattr(other, name)) for name in one.__dataclass_fields__)
    return type(one) is type(other) and one == other


def test_a_scene_survives_writing_and_reading(full, tmp_path):
    assert same(native.read(native.translate(full, (), tmp_path, "dusk")), full)


def test_a_native_scene_is_written_once_and_the_same(full, tmp_path):
    path = native.translate(full, (), tmp_path, "dusk")
    before = path.read_bytes(), path.stat().st_mtime_ns
    native.translate(full, (), tmp_path, "dusk")
    assert (path.read_bytes(), path.stat().st_mtime_ns) == before
    assert sorted(file.name for file in tmp_path.iterdir()) == ["dusk.json", "meshes"]
    assert len(list((tmp_path / "meshes").iterdir())) == 2


def test_mitsuba_lines_change_the_integrator(full, tmp_path):
    texts = [
        "integrator:integrator:direct",
        "integrator:maxDepth.integer = 9",
        "Camera-camera_sampler:sampler:ldsampler",
        "Camera-camera_sampler:sampleCount.integer  = 1024",
    ]
    lines = [NativeLine(text, "mappings.txt", number) for number, text in enumerate(texts)]
    read = native.read(native.translate(full, lines, tmp_path, "dusk"))
    assert asdict(read.integrator) == {
        "kind": "direct",
        "depth": 9,
        "samples": 1024,
        "seed": 3,
        "roulette": 0,
    }


@pytest.mark.parametrize(
    "text",
    [
        "integrator:integrator:photonmapper",
        "Vase-mesh:flipNormals.boolean = true",
        "integrator:maxDepth.integer = 0",
        "Camera-camera_sampler:sampleCount.integer = many",
        "nonsense",
    ],
)
def test_a_native_line_without_meaning_is_refused_where_it_stands(full, tmp_path, text):
    with pytest.raises(RecipeError, match=r"^mappings.txt:12: .*") as refused:
        native.translate(full, [NativeLine(text, "recipe/mappings.txt", 12)], tmp_path, "dusk")
    assert not str(refused.value).endswith(".")
    assert list(tmp_path.iterdir()) == []


def refused(scene, folder):
    with pytest.raises(RecipeError) as error:
        native.translate(scene, (), folder, "dusk")
    return str(error.value)


def test_what_the_tracer_lacks_is_said_in_one_sentence(full, tmp_path):
    measured = {**full.materials, "Paint": Material("Paint", "measured", {})}
    sentence = refused(replace(full, materials=measured), tmp_path)
    assert sentence.startswith(
        "material Paint is measured, which tracer cannot render; it knows matte, anisoward, metal"
    )
    assert not sentence.endswith(".")
    sunsky = Light("Sky", "sunsky", np.eye(4), {})
    assert "environment is sunsky" in refused(replace(full, environment=sunsky), tmp_path)
    textured = Material("Paint", "matte", {"diffuseReflectance": TextureUse("checks")})
    assert "texture checks" in refused(
        replace(full, materials={**full.materials, "Paint": textured}), tmp_path
    )


def test_a_scene_of_plain_things_lacks_nothing(full):
    assert fidelity.unsupported(full, "tracer") == []
    assert len(fidelity.unsupported(full, "somebody")) == 10


@pytest.mark.parametrize(("name", "value"), [("radius", -1.0), ("cone", 200.0), ("blend", float("nan"))])
def test_numbers_of_lights_are_checked(full, tmp_path, name, value):
    spot = replace(full.lights[1], parameters={**full.lights[1].parameters, name: value})
    assert f"light Spot-light has {name} {value}" in refused(replace(full, lights=(spot,)), tmp_path)


def test_a_shape_of_unknown_material_is_refused(full, tmp_path):
    assert "of material Paint, which" in refused(
        replace(full, materials={"Grün": full.materials["Grün"]}), tmp_path
    )


@pytest.mark.parametrize(
    "content",
    [
        "{",
        "[]",
        '{"format": "other", "version": 1}',
        '{"format": "RenderToolbox tracer scene", "version": 1}',
    ],
)
def test_a_damaged_native_scene_is_refused_in_one_sentence(tmp_path, content):
    file = tmp_path / "dusk.json"
    file.write_text(content)
    with pytest.raises(RenderingError, match=r"^dusk.json cannot be read, translate the scene again"):
        find("tracer").render(file, RenderOptions(), lambda fraction: None)


def test_the_tracer_never_imports_mitsuba():
    names = {
        name.split(".")[0]
        for path in ROOM.glob("*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Import | ast.ImportFrom) and not getattr(node, "level", 0)
        for name in (
            [node.module or ""] if isinstance(node, ast.ImportFrom) else [a.name for a in node.names]
        )
    }
    assert names <= {
        "__future__",
        "abc",
        "atexit",
        "base64",
        "collections",
        "concurrent",
        "dataclasses",
        "embreex",
        "functools",
        "importlib",
        "json",
        "numpy",
        "os",
        "pathlib",
        "queue",
        "subprocess",
        "typing",
    }


@pytest.mark.parametrize("start", [0, 64])
def test_random_numbers_fill_every_elementary_box(start):
    count = 64
    points = sequence(start + count)[:, start:] / 2.0**32
    for columns in (1, 2, 4, 8, 16, 32, 64):
        cells = np.floor(points[0] * columns) * (count // columns) + np.floor(points[1] * (count // columns))
        assert sorted(cells.tolist()) == list(range(count))


def test_each_pixel_has_numbers_of_its_own_and_all_fill_the_boxes():
    sampler = Sampler(np.array([7, 8, 9]), samples=16, pairs=4, seed=5, number=2)
    seen = set()
    for use in range(4):
        for pixel in range(3):
            u, v = sampler.pair(use, np.full(16, pixel), np.arange(16))
            assert sorted(np.floor(u * 16).tolist()) == sorted(np.floor(v * 16).tolist()) == list(range(16))
            seen.add(u.tobytes())
    assert len(seen) == 12
