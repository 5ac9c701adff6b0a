"""
Arithmetic in RenderToolbox4's mappings, by a small evaluator of its own: nothing else can be called.

    expression = term { ("+" | "-") term }        term = factor { ("*" | "/") factor }
    factor     = ("+" | "-") factor | number | name | name "(" [ expression { "," expression } ] ")"
               | "(" expression ")" | "[" expression { [","] expression } "]"

Inside ``[ ]`` blanks separate, as in MATLAB: ``[0 0 -1 - 2]`` holds three numbers. Matrices are (4, 4)
and act on row vectors: of a product the left factor acts first.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

import numpy as np

from ..errors import choices
from ..spectra import FloatArray
from . import matrices

# A number, a vector or a (4, 4) matrix.
Number = float | FloatArray
_TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)|([A-Za-z_]\w*)|(\S))")
_DEEPEST = 50


class _Function(NamedTuple):
    arguments: int
    call: Callable[..., Number]


_FUNCTIONS = {
    "deg2rad": _Function(1, np.radians),
    "rad2deg": _Function(1, np.degrees),
    "sin": _Function(1, np.sin),
    "cos": _Function(1, np.cos),
    "tan": _Function(1, np.tan),
    "sqrt": _Function(1, np.sqrt),
    "abs": _Function(1, np.abs),
    "mexximpIdentity": _Function(0, lambda: np.eye(4)),
    "mexximpTranslate": _Function(1, matrices.translation),
    "mexximpScale": _Function(1, matrices.scaling),
    "mexximpRotate": _Function(2, matrices.rotation),
    "mexximpLookAt": _Function(3, matrices.look_at),
}
_SIZES = {"mexximpTranslate": [3], "mexximpScale": [3], "mexximpRotate": [3, 1], "mexximpLookAt": [3, 3, 3]}


def evaluate(text: str, names: Mapping[str, Number]) -> Number:
    """
    Return what an expression comes to; ValueError with one sentence where it is none.

    Parameters
    ----------
    names : values of the names that it may use, such as oldValue
    """
    parser = _Parser(text, {"pi": np.pi, **names})
    with np.errstate(all="ignore"):
        found = parser.whole()
    if not np.isfinite(found).all():
        raise ValueError(f"'{text}' comes to no finite number")
    return found


class _Token(NamedTuple):
    kind: str
    text: str
    after_blank: bool
    before_blank: bool


def _tokens(text: str) -> Iterator[_Token]:
    for found in _TOKEN.finditer(text):
        kind = ("number", "name", "sign")[(found.lastindex or 1) - 1]
        word = found[found.lastindex or 1]
        after = found.end() < len(text) and text[found.end()].isspace()
        yield _Token(kind, word, len(found[0]) > len(word), after)
    yield _Token("end", "", False, False)


class _Parser:
    def __init__(self, text: str, names: Mapping[str, Number]) -> None:
        self._text, self._names = text, names
        self._tokens = list(_tokens(text))
        self._place = self._depth = 0
        self._in_vector = False

    def whole(self) -> Number:
        found = self._expression()
        self._expect("", "end")
        return found

    @property
    def _now(self) -> _Token:
        return self._tokens[self._place]

    def _expression(self) -> Number:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise ValueError(f"'{self._text[:40]}...' is nested too deeply")
        found = self._term()
        while self._now.text in ("+", "-") and not self._begins_element():
            sign = self._take().text
            other = self._term()
            found = _same_size(found, other, np.add if sign == "+" else np.subtract)
        self._depth -= 1
        return found

    def _begins_element(self) -> bool:
        """Return whether a sign belongs to the next number of a vector: blank before, none after."""
        return self._in_vector and self._now.after_blank and not self._now.before_blank

    def _term(self) -> Number:
        found = self._factor()
        while self._now.text in ("*", "/"):
            sign = self._take().text
            found = _product(found, self._factor()) if sign == "*" else _quotient(found, self._factor())
        return found

    def _factor(self) -> Number:
        token = self._take()
        if token.text in ("+", "-"):
            self._depth += 1
            if self._depth > _DEEPEST:
                raise ValueError(f"'{self._text[:40]}...' is nested too deeply")
            value = self._factor()
            self._depth -= 1
            return -value if token.text == "-" else value
        if token.kind == "number":
            return float(token.text)
        if token.kind == "name":
            calls = self._now.text == "(" and not (self._in_vector and self._now.after_blank)
            return self._called(token.text) if calls else self._named(token.text)
        if token.text == "(":
            return self._outside_vector(self._expression, ")")
        if token.text == "[":
            return self._vector()
        raise ValueError(
            f"cannot read '{self._text}' at '{token.text or 'its end'}', want a number or a name"
        )

    def _vector(self) -> Number:
        outer, self._in_vector = self._in_vector, True
        numbers: list[float] = []
        while self._now.text != "]":
            numbers += np.atleast_1d(self._expression()).ravel().tolist()
            if self._now.text == ",":
                self._take()
        self._in_vector = outer
        self._take()
        return np.array(numbers)

    def _outside_vector(self, read: Callable[[], Number], closing: str) -> Number:
        outer, self._in_vector = self._in_vector, False
        found = read()
        self._in_vector = outer
        self._expect(closing)
        return found

    def _called(self, name: str) -> Number:
        if name not in _FUNCTIONS:
            raise ValueError(f"no function is called {name}, there are {choices(name, _FUNCTIONS)}")
        self._take()
        arguments: list[Number] = []

        def read() -> Number:
            while self._now.text != ")":
                arguments.append(self._expression())
                if self._now.text != ",":
                    break
                self._take()
            return 0.0

        self._outside_vector(read, ")")
        return _call(name, arguments)

    def _named(self, name: str) -> Number:
        if name not in self._names:
            raise ValueError(
                f"nothing is called {name} in '{self._text}', there are {', '.join(self._names)}"
            )
        return self._names[name]

    def _take(self) -> _Token:
        token = self._now
        self._place += token.kind != "end"
        return token

    def _expect(self, text: str, kind: str = "sign") -> None:
        if (self._now.kind, self._now.text) != (kind, text):
            shown = self._now.text or "its end"
            raise ValueError(f"cannot read '{self._text}' at '{shown}'{f', want {text}' if text else ''}")
        self._take()


def _call(name: str, arguments: list[Number]) -> Number:
    function = _FUNCTIONS[name]
    if len(arguments) != function.arguments:
        raise ValueError(f"{name} takes {function.arguments} arguments, got {len(arguments)}")
    for argument, size in zip(arguments, _SIZES.get(name, []), strict=False):
        if np.size(argument) != size:
            raise ValueError(f"{name} wants {size} numbers, got {np.size(argument)}")
    return function.call(*arguments)


def _same_size(left: Number, right: Number, combine: Callable[..., Number]) -> Number:
    if np.ndim(left) and np.ndim(right) and np.shape(left) != np.shape(right):
        raise ValueError(f"{np.size(left)} and {np.size(right)} numbers cannot be added")
    return combine(left, right)


def _product(left: Number, right: Number) -> Number:
    if not (np.ndim(left) and np.ndim(right)):
        return np.multiply(left, right)
    if np.shape(left)[-1:] != np.shape(right)[:1] or np.ndim(right) < 2:
        raise ValueError(f"{np.shape(left)} and {np.shape(right)} numbers cannot be multiplied")
    return np.matmul(left, right)


def _quotient(left: Number, right: Number) -> Number:
    if np.ndim(right):
        raise ValueError("nothing can be divided by a vector or matrix")
    if float(right) == 0:
        raise ValueError("nothing can be divided by 0")
    return np.asarray(left, float) / float(right)
