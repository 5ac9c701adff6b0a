"""What mappings cannot say: a function edits the live scene for each condition, which is then written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from ..conditions import Condition
from ..errors import RecipeError
from ..recipe import PARENT
from ..spectra import Spectrum
from ..spectra.files import spd_text
from .keeping import Kept
from .statements import Statement, Varied

Remodel = Callable[[Any, Condition], object]
PARENT_COLUMNS = ("colladaFile", "parentScene")
_Written = TypeVar("_Written")


def baked(
    scene, conditions: Iterable[Condition], remodel: Remodel, write: Callable[[], _Written]
) -> list[_Written]:
    """Return what is written for each condition while a function has remodeled the scene for it."""
    written = []
    with Kept() as kept:
        for condition in conditions:
            try:
                with at_condition(condition.name):
                    remodel(scene, condition)
                    written.append(write())
            finally:
                kept.give_back()
    return written


@contextmanager
def at_condition(name: str) -> Iterator[None]:
    """Say which condition cannot be written, and why, where anything is raised."""
    try:
        yield
    except Exception as error:
        raise RecipeError(f"the condition {name} {_why(error)}") from error


def _why(error: Exception) -> str:
    """Return the end of a sentence: what a condition could not do."""
    if isinstance(error, RecipeError):
        return f"cannot be written: {error}"
    said = " ".join(str(error).split()).rstrip(".")
    return f"cannot be remodeled: {type(error).__name__}{f': {said}' if said else ''}"


def parent_files(names: Sequence[str], contents: Sequence[bytes]) -> tuple[list[str], dict[str, bytes]]:
    """
    Return each condition's cell that names its parent scene, and further files by name below resources/.

    Those that are the same share a file; it is called after the first condition that has it, or is the
    recipe's own parent scene when that is the first one of all.
    """
    if all(content is contents[0] for content in contents):  # a look into a big one takes its time
        return [PARENT] * len(contents), {}
    cells: dict[bytes, str] = {contents[0]: PARENT}
    files = {}
    for name, content in zip(names, contents, strict=True):
        if content not in cells:
            files[f"parent-{name}.dae"] = content
            cells[content] = f"resources/parent-{name}.dae"
    return [cells[content] for content in contents], files


def merged(names: Sequence[str], said: Sequence[Sequence[Statement]]) -> list[Statement]:
    """Return what mappings say about all parent scenes at once; what differs varies by condition."""
    first, *others = tables = [{each.id: each for each in statements} for statements in said]
    for name, table in zip(names[1:], others, strict=True):
        _refuse_other_kinds(names[0], first, name, table)
    return [_merged([table[id] for table in tables]) for id in first]


def _refuse_other_kinds(first: str, wanted: dict, name: str, found: dict) -> None:
    for id in dict.fromkeys((*wanted, *found)):
        for has, lacks, there in ((first, name, found), (name, first, wanted)):
            if id not in there:
                raise RecipeError(
                    f"the condition {has} has {id}, {lacks} has not: all need the same materials and lights"
                )
        if (one := _kind(wanted[id])) != (other := _kind(found[id])):
            was, is_now = (f"{model} {category}" for model, category, _ in (one, other))
            raise RecipeError(
                f"{id} is a {was} in the condition {first} and a {is_now} in {name}, "
                "all need the same kinds of materials and lights"
            )


def _kind(statement: Statement) -> tuple:
    parameters = sorted((*statement.spectra, *statement.numbers, *statement.words))
    return statement.model, statement.category, parameters


def _merged(same: Sequence[Statement]) -> Statement:
    one = same[0]
    spectra = {name: _one_or_varied([each.spectra[name] for each in same]) for name in one.spectra}
    numbers = {name: _one_or_varied([each.numbers[name] for each in same]) for name in one.numbers}
    words = {name: _one_or_varied([each.words[name] for each in same]) for name in one.words}
    return Statement(one.id, one.name, one.category, one.model, spectra, numbers, words)


def _one_or_varied(values: Sequence[Any]) -> Any:
    identities = {(each.unit, spd_text(each)) if isinstance(each, Spectrum) else each for each in values}
    return values[0] if len(identities) == 1 else Varied(tuple(values))
