import pytest

from rtb_addon.__main__ import main
from rtb_addon.batch import render_recipe
from rtb_addon.batch.plan import plan
from rtb_addon.errors import RecipeError, RecipeProblems
from rtb_addon.recipe import Recipe
from rtb_addon.recipe.remodeler import remodeled


def planned(recipe, names=None):
    chosen = [condition for condition in recipe.conditions if names is None or condition.name in names]
    return plan(recipe, chosen, fresh=False)


def test_every_missing_file_of_the_chosen_conditions_is_said_before_anything_is_rendered(
    write_family, capsys
):
    recipe = write_family({"a": "gone.spd", "b": "0.5", "c": "lost.spd", "d": "gone.spd"})
    assert main(["render", str(recipe.folder)]) == 2
    first, second = capsys.readouterr().err.splitlines()
    assert first.startswith("mappings.txt:3: there is no spectrum file gone.spd")
    assert first.endswith("(a, d)")
    assert second.startswith("mappings.txt:3: there is no spectrum file lost.spd")
    assert not (recipe.folder / "renderings").exists()
    assert not (recipe.folder / "log.jsonl").exists()
    with pytest.raises(RecipeProblems) as caught:
        list(render_recipe(recipe.folder))
    assert [problem.line for problem in caught.value.problems] == [3, 3]


def test_what_conditions_that_were_not_chosen_lack_hinders_nobody(write_family):
    recipe = write_family({"a": "gone.spd", "b": "0.5"})
    assert [condition.name for condition in planned(recipe, "b").waiting] == ["b"]


def test_a_condition_with_several_faults_says_them_all(write_family):
    recipe = write_family({"a": "gone.spd"})
    file = recipe.folder / "mappings.txt"
    file.write_text(file.read_text().replace("300:10 800:10", "lost.spd"))
    with pytest.raises(RecipeProblems, match=r"gone\.spd[^\n]*\n[^\n]*lost\.spd"):
        planned(Recipe.load(recipe.folder))
    assert len(Recipe.load(recipe.folder).problems()) == 2


def test_a_spectrum_file_that_cannot_be_read_is_foreseen_with_its_line(write_family):
    recipe = write_family({"a": "bad.spd"}, resources={"bad.spd": b"300 0.5\n800 half\n"})
    with pytest.raises(RecipeError, match=r"bad\.spd:2: "):
        planned(recipe)


def test_a_texture_is_missed_only_where_a_material_shows_it(write_family):
    recipe = write_family({"a": "0.5"})
    image = "<library_images><image id='i'><init_from>gone.png</init_from></image></library_images>"
    file = recipe.folder / "parent.dae"
    file.write_text(file.read_text().replace("<library_lights>", image + "<library_lights>"))
    assert len(planned(Recipe.load(recipe.folder)).waiting) == 1


def test_a_scene_is_built_only_where_a_value_looks_wrong_and_once_for_the_same_fault(
    write_family, monkeypatch
):
    built = []

    def build(recipe, condition, adjustments):
        built.append(condition.name)
        raise RecipeError("the scene has no camera")

    monkeypatch.setattr("rtb_addon.recipe.foresight.resolve_condition", build)
    good = write_family({"a": "0.5", "b": "0.6"})
    assert len(planned(good).waiting) == 2
    assert built == []
    bad = write_family({"a": "0.5", "b": "gone.spd", "c": "gone.spd", "d": "gone.spd"}, folder="bad")
    with pytest.raises(RecipeProblems, match=r"\(b, c, d\)\nthe scene has no camera \(b\)"):
        planned(bad)
    assert built == ["b"]


def test_a_recipe_s_code_is_run_to_look_ahead_only_where_something_looks_wrong(write_family):
    recipe = write_family({"a": "0.5", "b": "gone.spd"})
    (recipe.folder / "remodeler.py").write_text("raise SystemExit")
    coded = remodeled(Recipe.load(recipe.folder), trust=True)
    assert len(planned(coded, "a").waiting) == 1
    with pytest.raises(RecipeProblems, match=r"gone\.spd[^\n]*\n[^\n]*remodeler\.py:1: SystemExit"):
        planned(coded)


REMODELER = """\
def after_condition(document, condition):
    {}
    return document
"""


def remodeled_family(write_family, what):
    """Return a trusted recipe that lacks the paints of two conditions, with code that does something."""
    recipe = write_family({"a": "gone.spd", "b": "0.5", "c": "lost.spd"})
    (recipe.folder / "remodeler.py").write_text(REMODELER.format(what))
    return remodeled(Recipe.load(recipe.folder), trust=True)


def test_trusted_code_hides_no_missing_file(write_family):
    recipe = remodeled_family(write_family, "pass")
    with pytest.raises(RecipeProblems, match=r"gone\.spd[^\n]*\(a\)\n[^\n]*lost\.spd[^\n]*\(c\)$"):
        planned(recipe)
    assert len(recipe.problems()) == 2


def test_what_trusted_code_puts_right_hinders_no_condition(write_family):
    unpainted = "[g.getparent().remove(g) for g in document.of_kind('instance_geometry')]"
    recipe = remodeled_family(write_family, f"{unpainted} if condition.name == 'a' else None")
    with pytest.raises(RecipeError, match=r"lost\.spd[^\n]*\(c\)$"):
        planned(recipe)
    assert [each.name for each in planned(recipe, "ab").waiting] == ["a", "b"]
