"""A worker by itself: what it expects, what it is given, what it says."""

from rtb_addon.background import Event, send, start_child, stop
from rtb_addon.worker import Task


def test_a_worker_may_expect_what_is_wrong_and_renders_what_it_is_given(write_family, tmp_path):
    recipe, wrong = write_family({"light": "0.8"}), write_family({"light": "no spectrum"}, "wrong")
    expected = [str(wrong.folder), str(tmp_path / "nowhere"), str(recipe.folder)]
    said: list[Event] = []
    with start_child(expected, "rtb_addon.worker") as worker:
        assert worker.stdout is not None
        for folder in (recipe.folder, wrong.folder):
            assert send(worker, Task(str(folder), "light").to_json())
        while not {"done", "failed"} <= {event.kind for event in said}:
            said.append(Event.from_json(worker.stdout.readline()))
        stop(worker)
    (failure,) = (event for event in said if event.kind == "failed")
    assert failure.message.startswith("mappings.txt:3: 'no' is no wavelength:value pair")
    assert recipe.rendering_file(recipe.conditions["light"]).is_file()
