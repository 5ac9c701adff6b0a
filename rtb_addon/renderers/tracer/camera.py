"""From a place in the picture to a ray."""

from __future__ import annotations

import numpy as np

from ...scene.render_scene import Camera
from ...spectra import FloatArray
from .directions import disc, length


def rays(
    camera: Camera, x: FloatArray, y: FloatArray, lens: tuple[FloatArray, FloatArray] | None = None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """
    Return the origins, directions and reach [m] of rays through the picture.

    Rays begin on the near plane and reach to the far one. Those through a lens all meet on the plane that is
    sharp, where the ray through its middle would go. A mirrored camera needs no care: its matrix mirrors the
    rays.

    Parameters
    ----------
    x, y : (n,) arrays, 0 to 1 from the left and from the top of the picture
    lens : two (n,) arrays of random numbers in [0, 1), where through the lens; None for its middle
    """
    left, right, bottom, top = camera.window
    near, far = camera.clip
    window = np.stack([left + x * (right - left), top + y * (bottom - top), np.full_like(x, -1.0)])
    if camera.projection == "perspective":
        middle = np.zeros_like(window) if lens is None else camera.lens_radius * disc(*lens)
        ahead = window - middle / camera.focus_distance
        starts = middle + ahead * near
    else:
        starts = window * [[1], [1], [near]]
        ahead = np.broadcast_to([[0.0], [0.0], [-1.0]], window.shape)
    turn, place = camera.to_world[:3, :3], camera.to_world[:3, 3:]
    stretch = length(ahead)
    return turn @ starts + place, turn @ (ahead / stretch), (far - near) * stretch
