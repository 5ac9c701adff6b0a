"""Small pictures of radiance cubes, each as bright as can be: what a table shows of its conditions."""

from __future__ import annotations

import numpy as np

from .colorimetry import brightest_scale, encoded, linear_srgb
from .montage import tristimulus
from .spectral_image import SpectralImage
from .views import reduced


def thumbnail(cube: SpectralImage, side: int) -> np.ndarray:
    """Return a square 8-bit picture, (side, side, 4), the cube in its middle, transparent around it."""
    from PIL import Image

    by = max(max(cube.radiance.shape[:2]) // side, 1)  # light is averaged before it is encoded
    linear = linear_srgb(reduced(tristimulus(cube), by))
    picture = Image.fromarray(encoded(linear * brightest_scale(linear)))
    picture.thumbnail((side, side))
    square = np.zeros((side, side, 4), np.uint8)
    top, left = (side - picture.height) // 2, (side - picture.width) // 2
    square[top : top + picture.height, left : left + picture.width, :3] = np.asarray(picture)
    square[top : top + picture.height, left : left + picture.width, 3] = 255
    return square
