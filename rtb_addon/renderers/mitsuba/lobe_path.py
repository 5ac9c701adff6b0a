"""
The lobe path: one path through an rgb scene of one-hot colours carries every band.

Mitsuba computes coefficients that do not depend on wavelength (see one_hot.py); the spectra come from tables,
by the row of the material or emitter that a path meets. Nothing that a path does depends on the spectra, so
other spectra follow the same paths, in the same kernel. Drjit writes one kernel for the whole loop.

This module is imported only by what renders with Mitsuba, after its variant is set.
"""

from __future__ import annotations

import drjit as dr
import mitsuba as mi

from .band_groups import meet
from .tables import Tables

# How many of the paths that may end go on, at each bounce: about as many as light is left in a room.
_SURVIVAL = 0.7


@dr.syntax
def path_radiance(scene, tables: Tables, sampler, ray, worth, limits) -> list:
    """
    Follow paths and return their radiance, a list of one mi.Float for each band of the tables.

    Parameters
    ----------
    scene, sampler : Mitsuba's; the sampler is seeded, one sequence a path
    ray, worth : where the paths begin, and what each counts
    limits : longest path in Mitsuba's counting, and the length from which paths may end at random, each a
        mi.UInt32 in memory; None for the second: they never do
    """
    depth, roulette = limits
    lights = tables.lights
    radiance = [mi.Float(0) for _ in range(tables.padded_bands)]
    # The throughput is the product of these two: each band's own part, and what all bands share.
    spectral = [mi.Float(1) for _ in range(tables.padded_bands)]
    scalar = mi.Float(worth)
    bounce = mi.UInt32(1)
    active = mi.Bool(True)
    before = dr.zeros(mi.SurfaceInteraction3f)
    before_pdf = mi.Float(1)
    before_delta = mi.Bool(True)

    while active:
        si = scene.ray_intersect(ray, ray_flags=mi.RayFlags.All, coherent=bounce == 1, active=active)

        # What the surface or the sky emits, weighed against having been found by light sampling.
        emitter = si.emitter(scene)
        seen = mi.DirectionSample3f(scene, si, before)
        light_pdf = scene.pdf_emitter_direction(before, seen, active & ~before_delta)
        share = dr.select(before_delta, 1, before_pdf / (before_pdf + light_pdf))
        row = lights.row(emitter, active)
        glow = scalar * share * emitter.eval(si, active)[0] * lights.beam(row, -ray.d, active)
        shines = active & (glow != 0)
        radiance = _add(radiance, spectral, lights.emission(row, ray.d, shines), dr.select(shines, glow, 0))
        if dr.hint(lights.suns > 0, mode="scalar"):
            missed = active & ~si.is_valid() & before_delta
            radiance = _add_suns(lights, ray, radiance, spectral, dr.select(missed, scalar, 0))

        # One light sample, and one sample of the material.
        going = active & si.is_valid() & (bounce < depth)
        bsdf = si.bsdf()
        lit = going & mi.has_flag(bsdf.flags(), mi.BSDFFlags.Smooth)
        found, weight = sample_light(scene, lights, sampler, si, lit)
        lit &= found.pdf != 0
        towards = si.to_local(found.d)
        draws = sampler.next_1d(), sampler.next_2d()
        value, pdf, turn, onward = meet(tables, bsdf, si, towards, draws, going)
        share = dr.select(found.delta, 1, found.pdf / (found.pdf + pdf))
        row = lights.row(found.emitter, lit)
        glow = dr.select(lit, scalar * share * weight[0] * lights.beam(row, -found.d, lit), 0)
        emission = lights.emission(row, found.d, lit)
        seen_lit, spectral, scalar, glow = scatter(
            tables, spectral, scalar, (bsdf, si, going), (towards, value, glow), (turn.wo, onward)
        )
        radiance = _add(radiance, seen_lit, emission, glow)

        ray = si.spawn_ray(si.to_world(turn.wo))
        before = dr.detach(si, True)
        before_pdf = turn.pdf
        before_delta = mi.has_flag(turn.sampled_type, mi.BSDFFlags.Delta)
        bounce += 1
        active = going & (scalar != 0)
        if dr.hint(roulette is not None, mode="scalar"):
            # Nothing that a path has met decides, so that other spectra still follow the same paths.
            long = bounce >= roulette
            active &= ~long | (sampler.next_1d() < _SURVIVAL)
            scalar = dr.select(long, scalar / _SURVIVAL, scalar)
    return lights.in_the_end(radiance)


def sample_light(scene, lights, sampler, si, active):
    """Return a direction to a light that nothing hides, and the emitter's coefficient over its density."""
    if not lights.suns:
        return scene.sample_emitter_direction(si, sampler.next_2d(), True, active)
    found, weight = scene.sample_emitter_direction(si, sampler.next_2d(), False, active)
    u, v = sampler.next_2d()
    # A sun is a direction to Mitsuba; ours is anywhere in the disc around it, all places alike.
    height = u * lights.narrowness(lights.row(found.emitter, active), active)
    radius = dr.sqrt(height * (2 - height))
    sine, cosine = dr.sincos(v * dr.two_pi)
    aimed = mi.Frame3f(found.d).to_world(mi.Vector3f(radius * cosine, radius * sine, 1 - height))
    sun = height > 0
    found.d = dr.select(sun, aimed, found.d)
    found.p = dr.select(sun, si.p + aimed * found.dist, found.p)
    hidden = scene.ray_test(si.spawn_ray_to(found.p), active & (found.pdf != 0))
    return found, dr.select(hidden, 0, weight)


def scatter(tables, spectral, scalar, at, lit, turned):
    """
    Return the throughput towards a light, band by band, the two parts of that onward, and the light's weight.

    Parameters
    ----------
    at : the materials, where paths meet them, and which of them count
    lit : directions to the light, what meet() says of them, and its weight so far
    turned : directions of the paths, and what meet() says of them
    """
    if tables.all_bands:
        going = sum((abs(band) for band in turned[1]), mi.Float(0)) > 0
        onward = dr.select(going, scalar, 0)
        return _times(spectral, lit[1]), _times(spectral, turned[1]), onward, lit[2]
    (bsdf, si, active), (towards, value, glow), (wo, onward) = at, lit, turned
    row = tables.material_row(bsdf, active)
    lobes = [tables.reflectance(row, k, si.uv, active) for k in range(tables.lobes)]
    there, ahead = _with_metals(tables, lobes, row, (dr.dot(si.wi, towards), dr.dot(si.wi, wo)), active)
    if tables.lobes == 1:
        spectral_lit = _times(spectral, there[0])
        spectral = spectral_lit if tables.metals == 0 else _times(spectral, ahead[0])
        return spectral_lit, spectral, scalar * onward.x, glow * value.x
    value, ahead_of = (tables.coefficients(row, colour, active) for colour in (value, onward))
    spectral_lit = _times(spectral, _mix(there, value))
    going = dr.any(onward != 0)
    return spectral_lit, _times(spectral, _mix(ahead, ahead_of)), dr.select(going, scalar, 0), glow


def _with_metals(tables, lobes, row, cosines, active):
    """Return the spectra of lobes for each angle: those of metals times what they reflect at half of it."""
    if tables.metals == 0:
        return [lobes for _ in cosines]
    halves = [dr.sqrt(dr.maximum((1 + cosine) / 2, 0)) for cosine in cosines]
    shares = [tables.fresnel(row, k, halves, active) for k in range(tables.metals)]
    return [
        [
            _times(spectrum, shares[k][turn]) if k < tables.metals else spectrum
            for k, spectrum in enumerate(lobes)
        ]
        for turn in range(len(cosines))
    ]


def _add_suns(lights, ray, radiance, spectral, weight):
    """Add the discs of the suns where a ray that saw nothing else meets them."""
    for index in range(lights.suns):
        hit, disc = lights.sun(index, ray.d)
        radiance = _add(radiance, spectral, disc, dr.select(hit, weight, 0))
    return radiance


def _add(radiance, spectral, emission, weight):
    if emission is None:
        return [dr.fma(b, weight, total) for total, b in zip(radiance, spectral, strict=True)]
    return [dr.fma(b * e, weight, total) for total, b, e in zip(radiance, spectral, emission, strict=True)]


def _times(spectral, factors):
    return [b * f for b, f in zip(spectral, factors, strict=True)]


def _mix(lobes, coefficients):
    """Return the spectra of up to three lobes, weighed by their coefficients."""
    return [
        sum((row * coefficients[k] for k, row in enumerate(rows)), mi.Float(0))
        for rows in zip(*lobes, strict=True)
    ]
