"""
Physically based, multispectral families of stimuli.

The public names below are imported when somebody first uses them: importing this package costs
nothing, and Blender's own process stays free of what only renderings need.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .background import Event
    from .batch import render_condition, render_recipe
    from .batch.execute import execute_recipe
    from .conditions import Condition, Conditions
    from .errors import RecipeError, RenderingError
    from .mappings.default_mappings import default_mappings
    from .montage import make_montage
    from .old_recipes import import_recipe
    from .recipe import Recipe, write_recipe
    from .recipe.cleaning import clean_recipe
    from .recipe.new import new_recipe
    from .recipe.options import Conventions, MontageOptions, RecipeOptions
    from .recipe.packing import pack_recipe
    from .recipe.problems import check_recipe
    from .recipe.unpacking import unpack_recipe
    from .scene.build import SceneBuilder
    from .spectra import Bands, Spectrum
    from .spectral_image import SpectralImage

__all__ = [
    "Bands",
    "Condition",
    "Conditions",
    "Conventions",
    "Event",
    "MontageOptions",
    "Recipe",
    "RecipeError",
    "RecipeOptions",
    "RenderingError",
    "SceneBuilder",
    "SpectralImage",
    "Spectrum",
    "check_recipe",
    "clean_recipe",
    "default_mappings",
    "execute_recipe",
    "import_recipe",
    "make_montage",
    "new_recipe",
    "pack_recipe",
    "render_condition",
    "render_recipe",
    "unpack_recipe",
    "write_recipe",
]

_ROOMS = {
    ".background": ("Event",),
    ".batch": ("render_condition", "render_recipe"),
    ".batch.execute": ("execute_recipe",),
    ".conditions": ("Condition", "Conditions"),
    ".errors": ("RecipeError", "RenderingError"),
    ".mappings.default_mappings": ("default_mappings",),
    ".montage": ("make_montage",),
    ".old_recipes": ("import_recipe",),
    ".recipe": ("Recipe", "write_recipe"),
    ".recipe.cleaning": ("clean_recipe",),
    ".recipe.new": ("new_recipe",),
    ".recipe.options": ("Conventions", "MontageOptions", "RecipeOptions"),
    ".recipe.packing": ("pack_recipe",),
    ".recipe.problems": ("check_recipe",),
    ".recipe.unpacking": ("unpack_recipe",),
    ".scene.build": ("SceneBuilder",),
    ".spectra": ("Bands", "Spectrum"),
    ".spectral_image": ("SpectralImage",),
}
_PLACES = {name: room for room, names in _ROOMS.items() for name in names}


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_PLACES[name], __name__), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
