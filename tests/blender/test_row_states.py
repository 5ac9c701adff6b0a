"""How rows stand to their renderings: states, reasons and small pictures."""

from types import SimpleNamespace

import bpy
import pytest

from tests.blender.test_conditions import drawn


@pytest.fixture
def states(module):
    """The module that knows how batches have left the rows; nothing was rendered yet."""
    found = module("operators.row_states")
    found.clear()
    yield found
    found.clear()


def shown(states) -> list[str]:
    scene = bpy.context.scene
    return [states.state(scene, row, number) for number, row in enumerate(scene.rtb.conditions)]


def all_done(states) -> None:
    states.begin(bpy.context.scene)
    for name in ("a", "b", "c"):
        states.take(name, "done")


def test_each_row_shows_how_the_last_batch_has_left_it(settings, extension, states):
    assert not states.known(bpy.context.scene)
    states.begin(bpy.context.scene)
    for name, kind in (("a", "cached"), ("b", "started"), ("c", "failed")):
        states.take(name, kind)
    assert shown(states) == ["done", "running", "failed"]
    assert drawn(extension, "RTB_UL_conditions").names("operator") == ["rtb.show_condition"] * 3
    states.end()
    assert shown(states) == ["done", "", "failed"]


@pytest.mark.parametrize("how", ["cancelled", "the end"])
def test_a_row_whose_rendering_was_broken_off_is_what_it_was(settings, states, how):
    all_done(states)
    settings.samples += 1
    states.begin(bpy.context.scene)
    for name in ("a", "b"):
        states.take(name, "started")
    states.take("b", "progress")
    assert shown(states) == ["running", "running", "changed"]
    for name in ("a", "b"):
        if how == "cancelled":
            states.take(name, "cancelled")
    states.end()
    assert shown(states) == ["changed"] * 3


def test_only_the_row_whose_cell_is_changed_is_no_longer_done(settings, states):
    settings.conditions[2].name = ""
    states.begin(bpy.context.scene)
    for name in ("a", "b", f"{bpy.context.scene.name}-003"):
        states.take(name, "done")
    assert shown(states) == ["done"] * 3
    settings.conditions[1].cells[0].value = "0.9"
    assert shown(states) == ["done", "changed", "done"]
    settings.conditions[1].cells[0].value = "0.2"
    assert shown(states) == ["done"] * 3


@pytest.mark.parametrize("option", ["samples", "width", "seed", "depth"])
def test_other_options_change_every_row(settings, states, option):
    all_done(states)
    before = getattr(settings, option)
    setattr(settings, option, before + 1)
    assert shown(states) == ["changed"] * 3
    setattr(settings, option, before)
    assert shown(states) == ["done"] * 3


def test_written_mappings_change_every_row(settings, states):
    all_done(states)
    settings.mappings_text = bpy.data.texts.new("Mappings")
    settings.mappings_text.write("Generic {\n}\n")
    assert shown(states) == ["changed"] * 3


def test_states_belong_to_the_scene_that_was_rendered(settings, states):
    states.begin(bpy.context.scene)
    states.take("a", "done")
    assert states.known(bpy.context.scene)
    other = bpy.data.scenes.new("Other")
    assert not states.known(other)
    other.rtb.set_conditions(["imageName"], [["a"]])
    assert states.state(other, other.rtb.conditions[0], 0) == ""


def test_each_scene_keeps_the_states_of_its_rows(settings, states, tmp_path):
    all_done(states)
    first, other = bpy.context.scene, bpy.data.scenes.new("Other")
    other.rtb.set_conditions(["imageName"], [["a"], ["d"]])
    states.begin(other)
    states.take("d", "done")
    of = lambda scene: [states.state(scene, row, k) for k, row in enumerate(scene.rtb.conditions)]  # noqa: E731
    assert (of(first), of(other)) == (["done"] * 3, ["", "done"])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "two.blend"))
    assert of(bpy.data.scenes["Scene"]) == ["unchecked"] * 3
    assert of(bpy.data.scenes["Other"]) == ["", "unchecked"]


def test_an_edit_of_the_scene_leaves_all_rows_unchecked_until_they_are_rendered_again(settings, states):
    all_done(states)
    bpy.data.objects["Cube"].location[0] += 1
    bpy.context.view_layer.update()
    assert shown(states) == ["unchecked"] * 3
    states.begin(bpy.context.scene, ["b"])
    states.take("b", "cached")
    assert shown(states) == ["unchecked", "done", "unchecked"]
    bpy.context.scene.frame_set(7)
    assert shown(states) == ["unchecked"] * 3
    bpy.context.scene.frame_set(1)


def test_a_spectrum_that_is_chosen_from_the_menu_is_an_edit(settings, states):
    all_done(states)
    bpy.context.view_layer.objects.active = bpy.data.objects["Cube"]
    bpy.ops.rtb.use_flat_spectrum(field="REFLECTANCE", value=0.4)
    assert shown(states) == ["unchecked"] * 3


def test_looking_is_no_edit(settings, states):
    bpy.context.view_layer.update()
    bpy.ops.rtb.vary_property(home="objects", thing="Light", path="location", index=2, variable="height")
    settings.conditions[1].cells[2].value = "7"
    bpy.context.view_layer.update()
    all_done(states)
    bpy.ops.rtb.preview_condition(show=True)
    for row in (0, 1):
        settings.active_condition = row
        bpy.context.view_layer.update()
    assert bpy.data.objects["Light"].location[2] == 7
    bpy.ops.rtb.preview_condition(show=False)
    bpy.context.view_layer.update()
    bpy.context.view_layer.objects.active = bpy.data.objects["Light"]
    bpy.data.objects["Light"].select_set(True)
    bpy.context.view_layer.update()
    assert shown(states) == ["done"] * 3


def test_why_a_row_failed_is_said_by_its_tooltip_and_by_a_click(settings, states, module):
    states.begin(bpy.context.scene)
    states.take("b", "failed", "the lamp burnt out")
    button = SimpleNamespace(
        condition="b", bl_rna=SimpleNamespace(properties=[]), is_property_set=lambda name: False
    )
    verb = module("operators.show_condition").RTB_OT_show_condition
    assert verb.description(bpy.context, button).startswith("Failed: the lamp burnt out")
    with pytest.raises(RuntimeError, match="b: the lamp burnt out"):
        bpy.ops.rtb.show_condition(condition="b")
    states.begin(bpy.context.scene)
    states.take("b", "done")
    assert states.reason(bpy.context.scene, "b") == ""


def test_a_file_remembers_what_of_it_was_rendered(settings, states, tmp_path):
    all_done(states)
    states.take("c", "failed", "the lamp burnt out")
    settings.conditions[1].cells[0].value = "0.9"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "table.blend"))
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    assert not states.known(bpy.context.scene)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "table.blend"))
    assert shown(states) == ["unchecked", "changed", ""]


@pytest.mark.parametrize("text", ["", "[", "3", "[1, 2]", "[[], [], []]", '{"a": 1}'])
def test_what_a_strangers_file_says_of_a_row_does_no_harm(settings, states, text):
    settings.conditions[0].rendered = text
    states.remember(bpy.data.scenes)
    assert states.state(settings.id_data, settings.conditions[0], 0) == ""


@pytest.fixture
def thumbnails(family, module):
    """The module that has small pictures of two conditions that are rendered; the viewer ends afterwards."""
    bpy.ops.rtb.render_recipe()
    yield module("operators.thumbnails")
    module("operators.viewing").forget()
    module("operators.thumbnails").forget()


def test_a_row_that_is_rendered_gets_a_small_picture_of_it(thumbnails, states, family):
    bpy.ops.rtb.render_recipe()
    assert shown(states) == ["done", "done"]

    def ask() -> list:
        for name in ("blue", "green"):
            thumbnails.icon(family, name, states.version(family, name))
        thumbnails.fetch()
        return list(thumbnails._pictures)

    assert len(ask()) == 4, "one as it is and a dim one for each"
    blue, dim, green, _ = (list(each.icon_pixels_float) for each in thumbnails._pictures.values())
    # The picture is wider than high: nothing above it, and in its middle the colour of its paint.
    assert blue[: 4 * 5] == [0.0] * (4 * 5)
    middle = 4 * (32 * 16 + 16)
    assert blue[middle + 2] > blue[middle]
    assert green[middle + 1] > green[middle]
    assert dim == pytest.approx([each / 2 for each in blue], abs=1 / 255)
    states.begin(family)
    states.take("blue", "done")
    before = list(thumbnails._pictures)
    assert ask()[:2] == before[2:], "those of the older rendering have gone"
    assert len(thumbnails._pictures) == 4
    thumbnails.forget()
    assert not thumbnails._pictures


def test_a_thousand_wishes_ask_for_few_pictures(thumbnails, family):
    for number in range(1000):
        thumbnails.icon(family, f"row {number}", 0)
    for name in ("blue", "green"):
        thumbnails.icon(family, name, 0)
    thumbnails.fetch()
    assert not thumbnails._wanted
    known = [wish.name for wish in thumbnails._icons]
    assert len(known) == thumbnails.SEEN
    assert {"blue", "green"} < set(known)


def test_a_check_settles_what_edits_have_left_open(thumbnails, states, family, tmp_path):
    bpy.ops.rtb.render_recipe()
    place, before = bpy.data.objects["Cube"].location, bpy.data.objects["Cube"].location[0]
    place[0] = before + 1
    bpy.context.view_layer.update()
    assert shown(states) == ["unchecked"] * 2
    bpy.ops.rtb.check_recipe()
    assert shown(states) == ["changed"] * 2, "a cube that has moved is another picture"
    place[0] = before
    bpy.context.view_layer.update()
    bpy.ops.rtb.check_recipe()
    assert shown(states) == ["done"] * 2
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    assert shown(states) == ["unchecked"] * 2
    bpy.ops.rtb.check_recipe()
    assert shown(states) == ["done"] * 2
