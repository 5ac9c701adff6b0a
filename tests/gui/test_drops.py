"""Files dropped on the window of a real Blender, by another process, as a file manager does."""

SCRIPT, WINDOW = "in_drops.py", True


def test_blender_takes_whatever_is_dropped(report):
    assert report["taken"] == ["taken"] * 8


def test_a_dropped_spectrum_is_in_the_library(report):
    assert report[".spd"] == ["Own/my paint"]


def test_a_table_dropped_on_the_properties_is_a_spectrum_a_column(report):
    assert report[".csv"] == ["Own/two/high", "Own/two/low"]


def test_a_file_of_the_psychophysics_toolbox_may_be_dropped_on_the_outliner(report):
    assert report[".mat"] == [f"Own/sur_three/sur_three-{number}" for number in (1, 2, 3)]


def test_files_of_all_kinds_may_be_dropped_at_once(report):
    assert report["all spectra"] == sorted([*report[".spd"], *report[".csv"], *report[".mat"]])


def test_a_dropped_recipe_is_opened(report):
    assert report["recipe.json"] == ["cube", ["blue", "green"], 3]


def test_the_three_files_of_an_old_recipe_are_opened_together(report):
    assert report["old recipe"] == ["parent", ["blue", "green"], 3]


def test_a_parent_scene_with_mappings_in_json_is_opened(report):
    assert report["json recipe"] == ["newer", [], 3]


def test_blender_asks_nobody_about_a_folder(report):
    assert report["scenes of a folder"] == 0


def test_what_was_dropped_can_be_seen(shows):
    assert shows("dropped-spectra")
    assert shows("dropped-recipe")
