"""Arithmetic in RenderToolbox4's mappings, without eval."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rtb_addon.mappings.expressions import evaluate


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1 + 2 * 3", 7),
        ("(1 + 2) * 3", 9),
        ("7 - 2 - 1", 4),
        ("8 / 4 / 2", 1),
        ("-2 * -3", 6),
        ("1 - -1", 2),
        ("1e3 + .5", 1000.5),
        ("2 * value", 20),
        ("deg2rad(180)", math.pi),
        ("deg2rad((-45))", -math.pi / 4),
        ("rad2deg(pi)", 180),
        ("sqrt(9) + abs(-1)", 4),
        ("[1 2 3]", [1, 2, 3]),
        ("[1, 2,3]", [1, 2, 3]),
        ("[0 0 -100 - 0.1]", [0, 0, -100.1]),
        ("[1 -2]", [1, -2]),
        ("[1 - 2]", [-1]),
        ("[1 -2 + 3]", [1, 1]),
        ("[deg2rad(180) (1 -2)]", [math.pi, -1]),
        ("[1 2] * 2 + [1 1]", [3, 5]),
        ("[[1 2] 3]", [1, 2, 3]),
        ("[]", []),
    ],
)
def test_an_expression_comes_to_what_matlab_said(text, expected):
    np.testing.assert_allclose(evaluate(text, {"value": 10.0}), expected)


def moved(text, point, **names):
    """Return where a transformation for row vectors takes a point."""
    return (np.array([*point, 1]) @ evaluate(text, names))[:3]


@pytest.mark.parametrize(
    ("text", "point", "expected"),
    [
        ("mexximpTranslate([1 2 3])", (0, 0, 0), (1, 2, 3)),
        ("mexximpScale([2 3 4])", (1, 1, 1), (2, 3, 4)),
        ("mexximpRotate([0 0 1], deg2rad(90))", (1, 0, 0), (0, 1, 0)),
        ("mexximpRotate([0 0 2], pi / 2)", (0, 1, 0), (-1, 0, 0)),
        ("mexximpIdentity()", (1, 2, 3), (1, 2, 3)),
        # The left factor acts first on the object.
        ("mexximpScale([2 2 2]) * mexximpTranslate([1 0 0])", (1, 0, 0), (3, 0, 0)),
        ("mexximpTranslate([1 0 0]) * mexximpScale([2 2 2])", (1, 0, 0), (4, 0, 0)),
        ("mexximpTranslate([0 0 (1)]) * oldValue", (0, 0, 0), (0, 0, 2)),
        ("mexximpLookAt([5 0 0], [0 0 0], [0 0 1])", (0, 0, -5), (0, 0, 0)),
        ("mexximpLookAt([5 0 0], [0 0 0], [0 0 1])", (0, 1, 0), (5, 0, 1)),
    ],
)
def test_transformations_act_on_row_vectors(text, point, expected):
    found = moved(text, point, oldValue=np.diag([2.0, 2, 2, 1]))
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "at 'its end', want a number"),
        ("1 +", "at 'its end'"),
        ("1 2", "at '2'"),
        ("(1", "want \\)"),
        ("[1 2", "at 'its end'"),
        ("velue * 2", "nothing is called velue"),
        ("__import__(1)", "no function is called __import__, there are"),
        ("oldValue.shape", "at '.'"),
        ("deg2rad(1, 2)", "deg2rad takes 1 arguments, got 2"),
        ("mexximpRotate([0 0 1])", "takes 2 arguments"),
        ("mexximpTranslate([1 2])", "wants 3 numbers, got 2"),
        ("mexximpRotate([0 0 0], 1)", "needs an axis"),
        ("1 / 0", "divided by 0"),
        ("1 / [1 2]", "divided by a vector"),
        ("[1 2] + [1 2 3]", "2 and 3 numbers cannot be added"),
        ("[1 2] * [1 2]", "cannot be multiplied"),
        ("1e308 * 10", "no finite number"),
        ("sqrt(-1)", "no finite number"),
        ("(" * 1000 + "1", "nested too deeply"),
        ("-" * 1000 + "1", "nested too deeply"),
    ],
)
def test_what_is_no_expression_is_refused_in_a_sentence(text, words):
    with pytest.raises(ValueError, match=words):
        evaluate(text, {"value": 1.0, "oldValue": 2.0})


@given(st.text(max_size=40))
def test_any_text_at_all_comes_to_numbers_or_a_sentence(text):
    try:
        found = evaluate(text, {})
    except ValueError as error:
        found = 0.0 if str(error) else np.nan
    assert np.isfinite(found).all()


NUMBER = st.floats(-1e6, 1e6).map(lambda number: round(number, 3))


@given(NUMBER, NUMBER, NUMBER, st.sampled_from("+-*"), st.sampled_from("+-*"))
def test_sums_and_products_are_pythons(a, b, c, first, second):
    text = f"{a!r} {first} {b!r} {second} {c!r}"
    assert evaluate(text, {}) == pytest.approx(eval(text))
