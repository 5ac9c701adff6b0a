"""What the mappings will say about the parent scene: materials and lights with their spectra."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ..photometry import with_lumens
from ..spectra import Spectrum, Unit


@dataclass(frozen=True)
class Spoken:
    """
    A spectrum as somebody typed it, and what becomes of its numbers.

    Parameters
    ----------
    text : as spectra/spoken.py understands it, ``(variable)`` standing for a cell of the conditions
    owner : what it belongs to, for messages: the material Paint
    unit : of what comes out
    factor : of what comes out
    watts : power [W] that the spectrum is the shape of; None where its numbers count as they are
    lumens : the same as the eye weighs it [lm]
    """

    text: str
    owner: str
    unit: Unit = Unit.RATIO
    factor: float = 1.0
    watts: float | None = None
    lumens: float | None = None

    def meant(self, spectrum: Spectrum) -> Spectrum:
        """Return what a spectrum that was typed becomes [unit]."""
        carrying = spectrum if self.watts is None else spectrum.with_watts(self.watts)
        if self.lumens is not None:
            carrying = with_lumens(spectrum, self.lumens)
        return carrying.scaled(self.factor, self.unit)

    @property
    def is_shape(self) -> bool:
        """Whether only the shape of what is typed counts."""
        return self.watts is not None or self.lumens is not None

    @property
    def treatment(self) -> tuple:
        """What is done to the numbers: two that do the same can share their files."""
        return self.text, self.unit, self.factor, self.watts, self.lumens


@dataclass(frozen=True)
class Varied:
    """
    Spectra or numbers that differ from condition to condition, where parent scenes are baked.

    Parameters
    ----------
    values : one for each condition
    """

    values: tuple[Any, ...]


class Named(NamedTuple):
    """A word of a statement, or the id of something, with the type that mappings write: string, texture."""

    type: str
    text: str


@dataclass(frozen=True)
class Picture:
    """
    A picture, or what else was measured, that becomes a file of the recipe.

    Parameters
    ----------
    name : of the file
    content : of the file
    """

    name: str
    content: bytes = field(repr=False)


@dataclass(frozen=True)
class Statement:
    """
    A material, light or texture in the vocabulary.

    Parameters
    ----------
    id : in the parent scene
    name : its name in Blender, which its files get
    category, model : words of the vocabulary
    spectra : parameter -> its spectrum
    numbers : parameter -> its number
    words : parameter -> what else it is
    """

    id: str
    name: str
    category: str
    model: str
    spectra: Mapping[str, Spoken | Spectrum | Varied]
    numbers: Mapping[str, float | Varied]
    words: Mapping[str, Named | Picture | Varied] = field(default_factory=dict)
