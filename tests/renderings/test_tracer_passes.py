"""How the tracer paints: tiles, histories, rounds and processes leave no trace in the picture."""

import signal
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon.errors import Cancelled, RenderingError
from rtb_addon.exr import write_exr
from rtb_addon.renderers import find
from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.tracer import carried, histories, integrate, passes, together
from rtb_addon.renderers.tracer.film import offsets
from rtb_addon.renderers.tracer.intersect import best_kernel
from rtb_addon.renderers.tracer.lights.sky import Skies
from rtb_addon.scene.render_scene import Crop, Light, Mesh, Shape
from rtb_addon.spectra import Spectrum
from tests.renderings.test_tracer import busy_room
from tests.renderings.tracer_scenes import SQUARE, lamp, looking_down, matrix, matte, per_band, scene, sky

QUIET = RenderOptions()


@pytest.fixture(scope="module", autouse=True)
def _no_process_stays():
    yield
    together.stop_processes()


def shown(one, options=QUIET):
    """Return the radiance of a scene."""
    return passes.render(one, passes.Alone(one), options, lambda fraction: None).mean()


def test_histories_and_bands_make_the_same_picture(monkeypatch):
    """Once all spectra are multiplied at each surface, once only when all light is summed up."""
    room = busy_room(samples=16)
    by_history = shown(room)
    monkeypatch.setattr(integrate.World, "carrier", lambda world, n: carried.InBands(world.lights, n))
    np.testing.assert_allclose(by_history, shown(room), rtol=2e-5, atol=1e-7 * by_history.max())


def test_many_histories_are_summed_as_a_few_are(monkeypatch):
    room = busy_room(samples=16)
    expected = shown(room)
    monkeypatch.setattr(histories, "_DENSE", 0)
    np.testing.assert_allclose(shown(room), expected, rtol=1e-5)


def test_more_materials_than_the_table_of_histories_has_room_for():
    """A floor of a hundred paints under an even sky: each square shows its own."""
    paints = [matte(f"paint {n}", Spectrum.constant((n + 1) / 200)) for n in range(100)]
    squares = [
        Shape(f"square {n}", SQUARE, matrix((n % 10, n // 10, 0), (0.5, 0, 0), (0, 0.5, 0)), f"paint {n}")
        for n in range(100)
    ]
    camera = looking_down(5.0, (4.5, 4.5, 5))
    chart = scene(squares, materials=paints, camera=camera, size=(10, 10), samples=4, environment=sky(2.0))
    rows = (np.arange(100).reshape(10, 10)[::-1] + 1) / 100
    np.testing.assert_allclose(shown(chart), np.repeat(rows[:, :, None], 4, axis=2), rtol=1e-5)


def test_a_sky_without_colours_is_a_light_of_one_spectrum(tmp_path, monkeypatch):
    grey = np.random.default_rng(3).random((8, 16)).astype(np.float32)
    write_exr(tmp_path / "sky.exr", {}, dict.fromkeys("RGB", grey))
    picture = {"intensity": per_band([1, 2, 3, 4]), "filename": str(tmp_path / "sky.exr")}
    environment = Light("sky", "environment", np.eye(4), picture)
    room = replace(busy_room(samples=16), environment=environment)
    one = replace(room, shapes=room.shapes[1:3], lights=())
    assert passes.Alone(one).worlds[0].histories is not None
    by_history = shown(one)
    monkeypatch.setattr(Skies, "grey", property(lambda sky: None, lambda sky, spectrum: None))
    assert not passes.Alone(one).worlds[0].lights.plain
    np.testing.assert_allclose(by_history, shown(one), rtol=2e-5, atol=1e-6)


def test_other_spectra_meet_the_same_triangles_and_moved_shapes_others():
    one, again = (passes.Alone(busy_room(seed=seed)).worlds[0].surfaces for seed in (0, 1))
    assert one is again
    room = busy_room()
    painted = replace(room, materials={**room.materials, "red": matte("red", Spectrum.constant(0.7))})
    assert passes.Alone(painted).worlds[0].surfaces is one
    first, *others = room.shapes
    moved = replace(room, shapes=(replace(first, to_world=matrix((0, 0, 0.1))), *others))
    assert passes.Alone(moved).worlds[0].surfaces is not one
    assert passes.Alone(room, lambda corners: best_kernel(corners)).worlds[0].surfaces is not one


def test_a_mesh_without_triangles_is_not_in_the_way():
    room = busy_room()
    empty = Mesh(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    more = replace(room, shapes=(*room.shapes, Shape("empty", empty, matrix((9, 9, 9)), "red")))
    np.testing.assert_array_equal(shown(more), shown(room))


@pytest.mark.parametrize("options", [QUIET, RenderOptions(errors=True)])
def test_memory_beside_the_picture_does_not_grow_with_it(options):
    """Tiles bound it; for errors, a round, the mean, its spread and two steps between are pictures, too."""

    def beside(size):
        room = busy_room(size=size, samples=4, depth=2)
        tracemalloc.start()
        pixels = shown(room, options).nbytes
        _, peak = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return peak - pixels * (5 if options.errors else 1)

    beside((8, 8))
    # The small one fills a tile, too.
    small, large = beside((240, 160)), beside((480, 320))
    assert large < small + 1e6
    assert large < 60e6


def test_a_crop_is_that_part_of_the_picture_to_the_last_digits():
    room = busy_room()
    cut = replace(room, film=replace(room.film, crop=Crop(5, 3, 11, 7)))
    np.testing.assert_allclose(shown(cut), shown(room)[3:10, 5:16], rtol=1e-5)


def test_a_filter_weighs_to_one_and_reaches_as_far_as_it_says():
    u, v = np.random.default_rng(1).random((2, 200_000))
    for name, radius in {"tent": 1, "gaussian": 2, "mitchell": 2, "catmullrom": 2, "lanczos": 3}.items():
        x, y, weight = offsets(name, u, v)
        assert max(abs(x).max(), abs(y).max()) <= radius
        assert abs(weight.mean() - 1) < 4 * weight.std() / np.sqrt(len(u)) + 1e-6
        assert (weight.min() < 0) == (name in ("mitchell", "catmullrom", "lanczos"))


def test_an_error_in_another_process_is_told_as_in_this(tmp_path):
    near = lamp("point", matrix((0, 0, 1e-5)), [1, 9e29, 1, 1])
    floor = Shape("floor", SQUARE, matrix(), "grey")
    tracer = find("tracer")
    native = tracer.translate(scene([floor], [near], camera=looking_down(1e-12)), (), tmp_path, "scene")
    with pytest.raises(RenderingError, match=r"row 0, column 0 is inf at 500 nm"):
        tracer.render(native, RenderOptions(2), lambda fraction: None)
    native.write_text("{")
    with pytest.raises(RenderingError, match=r"scene.json cannot be read"):
        together.Together(native, 2)


def test_a_process_that_dies_is_told_and_the_next_picture_has_another(tmp_path):
    tracer = find("tracer")
    native = tracer.translate(busy_room(size=(40, 40)), (), tmp_path, "scene")
    painter = together.Together(native, 2)
    painter.processes[0].send_signal(signal.SIGTERM)
    painter.processes[0].wait()
    tiles = [passes.Tile(first, first + 100, 3, 0) for first in range(0, 1600, 100)]
    with pytest.raises(RenderingError, match="a process of the tracer ended"):
        list(painter.paint(tiles, lambda fraction: None))
    again = tracer.render(native, RenderOptions(2), lambda fraction: None).radiance
    np.testing.assert_array_equal(again, tracer.render(native, QUIET, lambda fraction: None).radiance)


def test_who_cancels_leaves_the_processes_to_the_next_picture(tmp_path):
    tracer = find("tracer")
    native = tracer.translate(busy_room(size=(120, 80), samples=64), (), tmp_path, "scene")

    def stop(fraction):
        if fraction > 0:
            raise Cancelled

    with pytest.raises(Cancelled):
        tracer.render(native, RenderOptions(2), stop)
    before = [one.pid for one in together.Together(native, 2).processes]
    whole = tracer.render(native, RenderOptions(2), lambda fraction: None).radiance
    assert [one.pid for one in together.Together(native, 2).processes] == before
    np.testing.assert_array_equal(whole, tracer.render(native, QUIET, lambda fraction: None).radiance)
