"""A recipe: a folder that holds everything a family of renderings needs."""

from .options import Conventions, MontageOptions, RecipeOptions
from .recipe import CONDITIONS, JSON_MAPPINGS, MAPPINGS, PARENT, Recipe
from .words import RECIPE
from .writing import write_recipe

__all__ = [
    "CONDITIONS",
    "JSON_MAPPINGS",
    "MAPPINGS",
    "PARENT",
    "RECIPE",
    "Conventions",
    "MontageOptions",
    "Recipe",
    "RecipeOptions",
    "write_recipe",
]
