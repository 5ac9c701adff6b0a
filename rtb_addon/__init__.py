"""
Physically based, multispectral families of stimuli.

The public names below are imported when somebody first uses them: importing this package costs
nothing, and Blender's own process stays free of what only renderings need.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_PLACES = {
    "Condition": ".conditions",
    "Conditions": ".conditions",
    "Conventions": ".recipe_options",
    "Event": ".background",
    "MontageOptions": ".recipe_options",
    "Recipe": ".recipe",
    "RecipeError": ".errors",
    "RecipeOptions": ".recipe_options",
    "RenderingError": ".errors",
    "SceneBuilder": ".scene.build",
    "SpectralImage": ".spectral_image",
    "Spectrum": ".spectra",
    "import_recipe": ".old_recipes",
    "make_montage": ".montage",
    "render_condition": ".batch",
    "render_recipe": ".batch",
    "write_recipe": ".recipe",
}

__all__ = list(_PLACES)


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_PLACES[name], __name__), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *_PLACES})
