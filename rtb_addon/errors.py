"""What can go wrong, said so that a person knows where and what would be right."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path


class RecipeError(Exception):
    """
    Something in a recipe is wrong; its text is one sentence for a person.

    Parameters
    ----------
    message : what is wrong and what would be right, no full stop
    file : the file that says it, if any
    line : its line, counted from 1
    """

    def __init__(self, message: str, file: str | Path | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.message, self.file, self.line = message, file, line

    def __str__(self) -> str:
        if self.file is None:
            return self.message
        place = Path(self.file).name if self.line is None else f"{Path(self.file).name}:{self.line}"
        return f"{place}: {self.message}"


class RecipeProblems(RecipeError):
    """
    Several things in a recipe are wrong; its text is a sentence a line.

    Parameters
    ----------
    problems : each of them
    """

    def __init__(self, problems: Iterable[RecipeError]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(map(str, self.problems)))


class RenderingError(Exception):
    """One rendering failed; the recipe may be right and the other conditions go on."""


class Cancelled(Exception):
    """Somebody asked to stop."""


@contextmanager
def at(file: str | Path | None, line: int | None = None) -> Iterator[None]:
    """Say where something is wrong, for ValueErrors and RecipeErrors that do not know it themselves."""
    try:
        yield
    except RecipeError as error:
        if error.file is not None:
            raise
        raise RecipeError(error.message, file, line) from error
    except ValueError as error:
        raise RecipeError(str(error), file, line) from error


def choices(word: str, known: Iterable[str], limit: int = 12) -> str:
    """Return what could stand in a word's place, the nearest first."""
    from difflib import (
        get_close_matches,
    )  # only when something is wrong: Blender's start does not wait for it

    names = {name.lower(): name for name in sorted(known)}
    near = [names[each] for each in get_close_matches(word.lower(), names, n=3)]
    listed = [*near, *(name for name in names.values() if name not in near)]
    return ", ".join(listed[:limit]) + (" ..." if len(listed) > limit else "") if listed else "nothing"
