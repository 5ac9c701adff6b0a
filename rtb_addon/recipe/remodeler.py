"""
A recipe's own code that changes its scenes, run only where somebody trusts it.

It travels as text: to the worker that runs it, and into each condition's key.
"""

from __future__ import annotations
import __future__

import ast
import codecs
import copy
import hashlib
import traceback
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from types import CodeType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..consent import has_consent
from ..errors import RecipeError
from ..scene.adjustments import Edit
from ..scene.document import Scene
from .handed_over import source_of

if TYPE_CHECKING:
    from . import Recipe

REMODELER = "remodeler.py"
UNTRUSTED = "it is code that came with the recipe; read it, then say --trust (in Python: trust=True)"
HOOKS = ("before_all", "before_condition", "after_condition")

Hook = Callable[[Scene, Any], Scene]


class Part(NamedTuple):
    """
    Code of one file.

    Parameters
    ----------
    source : its text
    file, line : where it stands, for messages
    """

    source: str
    file: str
    line: int = 1

    @property
    def compiled(self) -> CodeType:
        """The code, ready to run; raises what is wrong with it."""
        try:
            tree = ast.increment_lineno(ast.parse(self.source, self.file), self.line - 1)
            return compile(tree, self.file, "exec", __future__.annotations.compiler_flag, dont_inherit=True)
        except (SyntaxError, ValueError, RecursionError) as error:
            line = getattr(error, "lineno", None)
            raise RecipeError(
                f"this is no Python: {getattr(error, 'msg', error)}", self.file, line
            ) from error


@dataclass(frozen=True)
class Remodeler:
    """
    Functions that change the parent scene: before everything, before and after a condition's mappings.

    Parameters
    ----------
    parts : their code
    """

    parts: tuple[Part, ...]

    def __post_init__(self) -> None:
        for part in self.parts:
            part.compiled  # noqa: B018  what is no Python is said before anything is rendered

    @property
    def digest(self) -> str:
        """A digest of the code, wherever it stands."""
        return hashlib.sha256("\0".join(part.source for part in self.parts).encode()).hexdigest()

    @cached_property
    def hooks(self) -> dict[str, Hook]:
        """The functions by their names; asking for them runs the code."""
        found = {name: hook for part in self.parts for name, hook in _run(part).items()}
        if not found:
            raise RecipeError(f"it defines none of {', '.join(HOOKS)}", self.parts[0].file)
        return found

    def changed(self, hook: str, document: Scene, subject: Any, edits: tuple[Edit, ...] = ()) -> Scene:
        """
        Return what a function makes of a document, the document itself where there is no such function.

        Parameters
        ----------
        subject : the recipe or condition that the function is told
        edits : those that are in the document already
        """
        if (function := self.hooks.get(hook)) is None:
            return document
        mine = Scene(copy.deepcopy(document.root), document.file)
        made = self._called(hook, lambda: function(mine, subject))
        if not isinstance(made, Scene):
            code = getattr(function, "__code__", None)
            place = (code.co_filename, code.co_firstlineno) if code else (self.parts[0].file, None)
            raise RecipeError(f"{hook} returned {_kind(made)}, it must return the document", *place)
        return Scene(made.root, document.file, edits, document.remarks)

    def _called(self, name: str, call: Callable[[], Any]) -> Any:
        return _guarded(name, {part.file for part in self.parts}, call)


def remodeled(recipe: Recipe, functions: Sequence[Hook] = (), trust: bool = False) -> Recipe:
    """
    Return a recipe with its remodeler, or with functions in its place.

    Raises
    ------
    RecipeError
        When the folder holds a remodeler that nobody trusts.
    """
    if recipe.remodeler is not None:
        return recipe
    if functions:
        return replace(recipe, remodeler=_of(functions))
    if (code := code_of(recipe)) is None:
        return recipe
    if not (trust or has_consent(code)):
        raise RecipeError(UNTRUSTED, REMODELER)
    return replace(recipe, remodeler=_remodeler(code, recipe.folder / REMODELER))


def code_of(recipe: Recipe) -> bytes | None:
    """Return what a recipe's remodeler.py holds, None where there is none."""
    try:
        return (recipe.folder / REMODELER).read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise RecipeError(f"it cannot be read: {error.strerror}", REMODELER) from error


def digest_of(recipe: Recipe) -> str:
    """Return the digest of the code that remodels a recipe, trusted or not; empty where there is none."""
    if recipe.remodeler is not None:
        return recipe.remodeler.digest
    code = recipe.once(REMODELER, lambda: code_of(recipe))
    return "" if code is None else hashlib.sha256(code.removeprefix(codecs.BOM_UTF8)).hexdigest()


def _remodeler(code: bytes, file: Path) -> Remodeler:
    try:
        return Remodeler((Part(code.decode("utf-8-sig"), str(file)),))
    except UnicodeDecodeError as error:
        raise RecipeError("its text is not UTF-8", file) from error


def _of(functions: Iterable[Hook]) -> Remodeler:
    return Remodeler(tuple(Part(*source_of(function, HOOKS)) for function in functions))


def _run(part: Part) -> dict[str, Hook]:
    names: dict[str, Any] = {"__name__": "remodeler", "__file__": part.file}
    _guarded("", {part.file}, lambda: exec(part.compiled, names))
    return {name: names[name] for name in HOOKS if callable(names.get(name))}


def _guarded(name: str, files: set[str], call: Callable[[], Any]) -> Any:
    """Call a recipe's code; whatever it raises becomes one sentence with its line."""
    try:
        return call()
    except (Exception, SystemExit) as error:
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename in files]
        file, line = (frames[-1].filename, frames[-1].lineno) if frames else (min(files), None)
        said = error.message if isinstance(error, RecipeError) else f"{type(error).__name__}: {error}"
        raise RecipeError(f"{name}{': ' * bool(name)}{said}".replace("\n", " "), file, line) from error


def _kind(value: Any) -> str:
    return "nothing" if value is None else f"a {type(value).__name__}"
