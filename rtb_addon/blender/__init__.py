"""The bridge: the one room that knows Blender and recipes. What is heavy comes when it is called."""

from __future__ import annotations

from .conditions import set_conditions
from .properties import register, unregister


def read_recipe(scene, remodel=None):
    """
    Return the recipe of a scene (a SceneRecipe); the last look at Blender, from its main thread.

    Parameters
    ----------
    remodel : function that edits the scene for one condition, ``remodel(scene, condition)``: modifiers, shape
        keys, geometry nodes, the frame, anything; each condition then has its own parent scene, conditions
        that look the same share one, and the scene is as before afterwards
    """
    from . import reading

    return reading.read_recipe(scene, remodel)


def recipe_folder(scene):
    """Return the folder (a Path) that a scene's recipe is written to."""
    from .folders import recipe_folder as folder_of

    return folder_of(scene)


__all__ = ["read_recipe", "recipe_folder", "register", "set_conditions", "unregister"]
