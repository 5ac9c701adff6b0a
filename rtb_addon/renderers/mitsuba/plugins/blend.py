"""
The plugin fairblend: two materials, one taken at random.

Mitsuba's own blendbsdf divides by a density in which that of a mirror, which is none, is added to that of
a matte surface: where the two meet, version 3.9 loses up to half of the light.
"""

from __future__ import annotations

from types import ModuleType
from typing import Any


def blend_plugin(mi: ModuleType) -> Any:
    """Return the plugin's class for Mitsuba's present variant: weight, and the materials first and second."""
    import drjit as dr

    class Blend(mi.BSDF):
        def __init__(self, props):
            mi.BSDF.__init__(self, props)
            self.parts = [props["first"], props["second"]]
            self.weight = dr.opaque(mi.Float, props.get("weight", 0.5))
            self.m_components = [part.flags(k) for part in self.parts for k in range(part.component_count())]
            self.m_flags = self.parts[0].flags() | self.parts[1].flags()

        def sample(self, ctx, si, sample1, sample2, active=True):
            second = active & (sample1 < self.weight)
            first = active & (sample1 >= self.weight)
            found, value = self.parts[0].sample(
                ctx, si, (sample1 - self.weight) / dr.maximum(1 - self.weight, 1e-9), sample2, first
            )
            other, its = self.parts[1].sample(
                ctx, si, sample1 / dr.maximum(self.weight, 1e-9), sample2, second
            )
            found = dr.select(second, other, found)
            value = dr.select(second, its, value)
            # Both might have chosen a direction that is not a mirror's.
            smooth = active & ~mi.has_flag(found.sampled_type, mi.BSDFFlags.Delta) & (found.pdf > 0)
            whole, density = self.eval_pdf(ctx, si, found.wo, smooth)
            smooth &= density > 0
            found.pdf = dr.select(smooth, density, found.pdf)
            return found, dr.select(smooth, whole / dr.select(smooth, density, 1), value)

        def eval(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[0]

        def pdf(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[1]

        def eval_pdf(self, ctx, si, wo, active=True):
            (value, density), (its, other) = (part.eval_pdf(ctx, si, wo, active) for part in self.parts)
            return dr.lerp(value, its, self.weight), dr.lerp(density, other, self.weight)

        def eval_pdf_sample(self, ctx, si, wo, sample1, sample2, active=True):
            return *self.eval_pdf(ctx, si, wo, active), *self.sample(ctx, si, sample1, sample2, active)

        def to_string(self):
            return f"Blend[{self.parts}]"

    return Blend
