"""
What small mirrors return of the light that comes, by first principles and without a renderer.

Light that comes from a direction o meets mirrors with slopes (p, q), as often as their distribution says and
as much as they lie across its way: P(p, q) (o_z - p o_x - q o_y). Those that others hide return nothing, nor
is light that a mirror sends into others followed any further: what is missing to 1 is lost. How many are
hidden is what Smith's theory makes of the slopes along one line alone: 1 / (1 + L), with L the mean of what
of the slopes is steeper than the direction, over that direction's own steepness.
"""

from functools import cache

import numpy as np
from scipy import integrate, interpolate

from tests.renderings.tracer_scenes import reflected_by

# The distribution of slopes along a line, for a roughness of 1.
_ALONG = {
    "beckmann": lambda q: np.exp(-(q**2)) / np.sqrt(np.pi),
    "ggx": lambda q: 0.5 / (1 + q**2) ** 1.5,
}
# That of slopes in the plane, times pi.
_IN_PLANE = {"beckmann": lambda r: np.exp(-(r**2)), "ggx": lambda r: 1 / (1 + r**2) ** 2}


@cache
def _not_hidden(name):
    """Return the share that is not hidden for a roughness of 1, a curve over the angle from the normal."""
    angles = np.linspace(0, np.pi / 2, 200)
    steepness = 1 / np.tan(angles[1:-1])
    steeper = [integrate.quad(lambda q, s=s: (q - s) * _ALONG[name](q), s, np.inf)[0] for s in steepness]
    return interpolate.CubicSpline(angles, [1, *(1 / (1 + steeper / steepness)), 0])


def in_sight(name, roughness, cosines):
    """Return Smith's share of mirrors that are not hidden, towards directions by their cosines."""
    tangents = np.sqrt(np.maximum(1 / np.maximum(cosines, 1e-9) ** 2 - 1, 0))
    # Twice the slopes at half the tangent are the same lines.
    return _not_hidden(name)(np.arctan(roughness * tangents))


def mirrors(name, roughness, degrees, count):
    """
    Return the small mirrors that light meets that comes at an angle [degrees], in the plane y = 0.

    Their (n, 3) normals, the light's direction, and how much of it each would get if none hid any.
    """
    # Steps in the angle whose tangent is the slope, so that long tails are short.
    steps = (np.arange(count) + 0.5) / count
    steep, turn = np.meshgrid(np.tan(steps * np.pi / 2), steps * np.pi, indexing="ij")
    share = 2 * steep * _IN_PLANE[name](steep) * (1 + steep**2) * np.pi / 2 / count**2
    p, q = (roughness * steep * wave(turn) for wave in (np.cos, np.sin))
    o = np.array([np.sin(np.radians(degrees)), 0, np.cos(np.radians(degrees))])
    met = share * np.maximum(o[2] - p * o[0], 0) / o[2]
    normals = np.stack([-p, -q, np.ones_like(p)], axis=-1).reshape(-1, 3)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True), o, met.ravel()


def returned(name, roughness, degrees, eta, k=0.0, count=600):
    """Return the shares of light that are reflected and, where k is 0, that are refracted, each once."""
    h, o, met = mirrors(name, roughness, degrees, count)
    cosine = np.clip(h @ o, 0, 1)
    share = reflected_by(eta, k, np.degrees(np.arccos(cosine)))
    seen = met * in_sight(name, roughness, o[2:])
    up = 2 * cosine * h[:, 2] - o[2]
    back = (seen * share * in_sight(name, roughness, up))[up > 0].sum()
    if k:
        return back, 0.0
    inside = np.sqrt(np.maximum(1 - (1 - cosine**2) / eta**2, 0))
    down = -((cosine / eta - inside) * h[:, 2] - o[2] / eta)
    through = (seen * (1 - share) * in_sight(name, roughness, down))[down > 0].sum()
    return back, through
