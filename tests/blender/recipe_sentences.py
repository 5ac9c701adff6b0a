"""How a recipe is refused."""

import pytest


def sentence(library, act) -> str:
    """Return the one sentence that something is refused with."""
    with pytest.raises(library("errors").RecipeError) as caught:
        act()
    text = str(caught.value)
    assert not text.endswith(".")
    assert "\n" not in text
    return text
