import json
import os
import time
from dataclasses import replace

import numpy as np
import pytest

from rtb_addon import consent
from rtb_addon.__main__ import main
from rtb_addon.batch import render_condition, render_recipe
from rtb_addon.errors import RecipeError
from rtb_addon.recipe import Recipe
from rtb_addon.recipe.problems import check_recipe
from rtb_addon.spectral_image import SpectralImage
from rtb_addon.user_folders import settings_folder

# Paints the square in the grey that a row names.
CODE = """\
def after_condition(document, condition):
    for colour in document.element("Paint-effect").iter("{*}color"):
        colour.text = f"{condition.cells['paint']} " * 3 + "1"
    return document
"""
LIGHT_ONLY = """\
Generic {
    Lamp-light:light:point
    Lamp-light:intensity.spectrum = 300:10 800:10
}
"""


@pytest.fixture(autouse=True)
def _own_settings(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))


@pytest.fixture
def remodeled(write_family):
    """Return a function that writes a family whose paint comes from the parent scene, and some code."""

    def write(code=CODE, paints=None, mappings=LIGHT_ONLY):
        recipe = write_family(paints or {"a": "0.2", "b": "0.8"})
        (recipe.folder / "mappings.txt").write_text(mappings)
        if code is not None:
            (recipe.folder / "remodeler.py").write_text(code)
        return Recipe.load(recipe.folder)

    return write


def reflectance(recipe, name, **words):
    return float(render_condition(recipe, name, **{"trust": True, **words}).image.radiance.mean())


def sentence_of(recipe, name="a", **words):
    with pytest.raises(RecipeError) as caught:
        render_condition(recipe, name, **{"trust": True, **words})
    return str(caught.value)


def test_code_that_nobody_trusts_does_not_run_and_the_sentence_says_how_to_trust_it(remodeled, capsys):
    recipe = remodeled("import pathlib\npathlib.Path('ran').touch()\n" + CODE)
    for verb in ("render", "check"):
        assert main([verb, str(recipe.folder)]) == 2
        assert capsys.readouterr().err.strip() == (
            "remodeler.py: it is code that came with the recipe; read it, then say --trust"
            " (in Python: trust=True)"
        )
    with pytest.raises(RecipeError, match="--trust"):
        render_condition(recipe, "a")
    assert len(check_recipe(recipe.folder)) == 1
    assert not os.path.exists("ran")  # noqa: PTH110
    assert not (recipe.folder / "renderings").exists()


def test_trusted_code_has_the_last_word_in_every_condition(remodeled, capsys):
    recipe = remodeled()
    assert main(["check", str(recipe.folder), "--trust"]) == 0
    assert main(["render", str(recipe.folder), "--trust", "--jobs", "1", "--json"]) == 0
    means = [
        SpectralImage.load(recipe.rendering_file(condition)).radiance.mean()
        for condition in recipe.conditions
    ]
    np.testing.assert_allclose(means[1] / means[0], 4, rtol=1e-3)
    record = json.loads(recipe.record_file(recipe.conditions["a"]).read_text())
    assert len(record["remodeler"]) == 64


def test_consent_holds_for_these_bytes_and_no_others(remodeled):
    recipe = remodeled()
    code = (recipe.folder / "remodeler.py").read_bytes()
    assert not consent.has_consent(code)
    consent.give_consent(code, "family/remodeler.py")
    assert reflectance(recipe, "a", trust=False) == pytest.approx(0.2, rel=1e-3)
    (recipe.folder / "remodeler.py").write_bytes(code + b"# more\n")
    assert "--trust" in sentence_of(Recipe.load(recipe.folder), trust=False)
    consent.withdraw_consent(code)
    assert not consent.has_consent(code)


def test_a_spoilt_store_of_consent_is_no_consent(remodeled):
    recipe = remodeled()
    file = settings_folder() / consent.STORE
    file.parent.mkdir(parents=True)
    for text in ("{", "[]", '"x"'):
        file.write_text(text)
        assert "--trust" in sentence_of(recipe, trust=False)


def test_before_all_comes_first_then_before_condition_then_mappings_then_after_condition(remodeled):
    def coded(hook, value):
        return (
            f"def {hook}(document, subject):\n"
            f"    colour = next(document.element('Paint-effect').iter('{{*}}color'))\n"
            f"    colour.text = ' '.join([str(float(colour.text.split()[0]) {value})] * 3) + ' 1'\n"
            "    return document\n"
        )

    path = "Paint-effect:profile_COMMON:technique|sid=common:lambert:diffuse:color|sid=diffuse"
    mapped = LIGHT_ONLY + f"Collada {{\n    {path} = 0.1 0.1 0.1 1\n}}\n"
    assert reflectance(remodeled(coded("before_all", "* 0.5")), "a") == pytest.approx(0.25, rel=1e-3)
    chain = (
        coded("before_all", "* 0.5") + coded("before_condition", "+ 0.1") + coded("after_condition", "* 2")
    )
    assert reflectance(remodeled(chain), "a") == pytest.approx(0.7, rel=1e-3)
    assert reflectance(remodeled(chain, mappings=mapped), "a") == pytest.approx(0.2, rel=1e-3)


def test_values_that_mappings_read_from_the_parent_scene_are_those_that_before_all_left(remodeled):
    code = """\
def before_all(document, recipe):
    document.element("Camera-camera").find(".//{*}xfov").text = "0.3"
    return document
"""
    path = "Camera-camera:optics:technique_common:perspective:xfov|sid=xfov"
    paint = f"Paint-material:material:matte\n Paint-material:diffuseReflectance.spectrum = [{path}]"
    recipe = remodeled(code, mappings=f"{LIGHT_ONLY}Generic {{\n {paint}\n}}\n")
    assert reflectance(recipe, "a") == pytest.approx(0.3, rel=1e-3)
    assert "0.3" in json.dumps(json.loads(recipe.record_file(recipe.conditions["a"]).read_text())["mappings"])


def test_before_all_is_called_once_and_sees_the_recipe_and_no_condition_sees_another_s_changes(remodeled):
    code = """\
calls = []
def before_all(document, recipe):
    calls.append(recipe.name)
    return document
def before_condition(document, condition):
    colour = next(document.element("Paint-effect").iter("{*}color"))
    assert calls == ["family"], calls
    assert colour.text.startswith("0.5"), colour.text
    colour.text = "0.9 0.9 0.9 1"
    return document
"""
    recipe = remodeled(code)
    from rtb_addon.recipe.remodeler import remodeled as with_code

    recipe = with_code(recipe, trust=True)
    assert [reflectance(recipe, name) for name in "ab"] == pytest.approx([0.9, 0.9], rel=1e-3)


@pytest.mark.parametrize(
    ("code", "sentence"),
    [
        ("def after_condition(document, condition)\n", "remodeler.py:1: this is no Python: expected ':'"),
        ("x = 1\n\ny = 1 / 0\n", "remodeler.py:3: ZeroDivisionError: division by zero"),
        ("x = 1\n", "remodeler.py: it defines none of before_all, before_condition, after_condition"),
        (
            "def before_all(document, recipe):\n    return nothing\n",
            "remodeler.py:2: before_all: NameError: name 'nothing' is not defined",
        ),
        (
            "def after_condition(document, condition):\n    pass\n",
            "remodeler.py:1: after_condition returned nothing, it must return the document",
        ),
        (
            "def after_condition(document, condition):\n    raise SystemExit('two\\nlines')\n",
            "remodeler.py:2: after_condition: SystemExit: two lines",
        ),
        (
            "def f(x):\n    x.linked('#gone', 'camera')\n"
            "def before_all(document, recipe):\n    f(document)\n",
            "remodeler.py:2: before_all: there is no camera #gone, only Camera-camera",
        ),
    ],
)
def test_what_is_wrong_in_code_is_one_sentence_with_its_line(remodeled, code, sentence):
    assert sentence_of(remodeled(code)) == sentence


def test_code_goes_into_the_key_wherever_the_folder_lies(remodeled):
    recipe = remodeled()
    assert render_condition(recipe, "a", trust=True).new
    assert not render_condition(recipe.folder, "a", trust=True).new
    (recipe.folder / "remodeler.py").write_text(CODE + "# louder\n")
    assert render_condition(recipe.folder, "a", trust=True).new


def test_a_function_handed_over_travels_to_the_worker_as_its_source(remodeled):
    def after_condition(document, condition):
        import re

        for colour in document.element("Paint-effect").iter("{*}color"):
            colour.text = re.sub("0.5", condition.cells["paint"], colour.text)
        return document

    recipe = remodeled(code=None)
    events = list(render_recipe(recipe.folder, jobs=1, remodelers=[after_condition]))
    assert [event.kind for event in events if event.condition and event.kind == "failed"] == []
    assert SpectralImage.load(recipe.rendering_file(recipe.conditions["b"])).radiance.mean() == pytest.approx(
        0.8, rel=1e-3
    )
    assert {e.kind for e in render_recipe(recipe.folder, remodelers=[after_condition])} == {
        "started",
        "cached",
        "finished",
    }


def test_a_function_that_cannot_travel_alone_is_refused_with_what_it_lacks(remodeled):
    factor = 2

    def after_condition(document, condition):
        json.dumps(factor)
        return document

    def before_all(document, recipe):
        raise ValueError("not today")

    def paint(document, condition):
        return document

    recipe = remodeled(code=None)
    uses = (
        "after_condition uses factor, json from outside, but travels alone; import or define that inside it"
    )
    assert sentence_of(recipe, remodelers=[after_condition]) == uses
    assert "paint is no remodeler, write a function called before_all or" in sentence_of(
        recipe, remodelers=[paint]
    )
    assert "<lambda> is no remodeler" in sentence_of(recipe, remodelers=[lambda document, recipe: document])
    line = before_all.__code__.co_firstlineno + 1
    said = f"test_remodeler.py:{line}: before_all: ValueError: not today"
    assert sentence_of(recipe, remodelers=[before_all]) == said


def test_code_that_hangs_is_stopped_like_any_rendering(remodeled):
    recipe = remodeled("import time\ndef before_all(document, recipe):\n    time.sleep(60)\n")
    began: list[float] = []
    for event in render_recipe(recipe.folder, jobs=1, trust=True, cancelled=lambda: bool(began)):
        if event.condition:
            began.append(time.monotonic())
    assert time.monotonic() - began[0] < 1


def test_a_recipe_without_code_has_the_key_that_it_always_had(remodeled):
    recipe = remodeled(code=None)
    assert render_condition(recipe, "a").new
    assert not render_condition(replace(recipe), "a", trust=True).new
