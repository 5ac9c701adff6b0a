"""What can go wrong, said so that a person knows where and what would be right."""

from __future__ import annotations

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


class RenderingError(Exception):
    """One rendering failed; the recipe may be right and the other conditions go on."""


class Cancelled(Exception):
    """Somebody asked to stop."""
