"""
The lobe path against stock Mitsuba, in one interleaved run, and what a family of conditions costs.

    python benchmarks/lobe_path.py [rounds] [size] [threads] [material of the block]

For a Cornell-like box and for a mesh of 326 432 triangles under a picture of the sky, each with a block that
is metal, matte, roughplastic or anisoward, it prints for each way of rendering

- its processor time over that of a stock rgb render of equal samples, which has 3 numbers a pixel, not 31;
- its efficiency, 1 / (relative mean squared error x time), over that of the stock spectral film, with the
  same sampler and as shipped: by the mean error over pixels and bands, and by their median.

Then what each condition of a family takes: loading, compiling and following paths.
"""

import sys
import tempfile
import time
from functools import partial
from pathlib import Path
from xml.etree import ElementTree as Xml

import lobe_scenes
import numpy as np

from rtb_addon.renderers.interface import RenderOptions
from rtb_addon.renderers.mitsuba import llvm, renderer, session
from rtb_addon.renderers.mitsuba.native import read_native
from rtb_addon.renderers.mitsuba.one_hot import one_hot

SPECTRAL = "llvm_ad_spectral"
YARDSTICK, FILM, FILM_AS_SHIPPED = (
    "stock rgb, 3 numbers",
    "stock specfilm, multijitter",
    "stock specfilm as shipped",
)
AVERAGED, MEAN = "lobe path, averaged", "lobe path, mean"
# Squares, which jitter spreads evenly.
SAMPLES = {"box": 64, "mesh": 144}
FAMILY_SAMPLES = 16


def stock(native, samples, threads, variant, sampler):
    """Return a function of the seed that renders a native scene the way stock Mitsuba does."""
    mi = session.start(variant, threads)
    root = as_rgb(native) if variant == session.FAST else Xml.parse(native).getroot()
    for node in root.iter("sampler"):
        node.set("type", sampler)
        for child in [child for child in node if sampler == "independent" and child.get("name") == "seed"]:
            node.remove(child)
    for node in root.iter("string"):
        if node.get("name") == "filename":
            node.set("value", str((native.parent / node.get("value")).resolve()))
    for emitter in [node for node in root if node.get("type") == "skypicture"]:
        root[list(root).index(emitter)] = envmap(emitter)
    scene = mi.load_string(Xml.tostring(root, encoding="unicode"))
    return lambda seed: np.array(mi.render(scene, spp=samples, seed=seed))


def as_rgb(native):
    """Return a native scene for rgb variants, with some colour in the place of each spectrum."""
    root = Xml.fromstring(one_hot(read_native(native)).xml)
    integrator = Xml.SubElement(root, "integrator", type="path")
    for name, depth in (("max_depth", "6"), ("rr_depth", "7")):
        Xml.SubElement(integrator, "integer", name=name, value=depth)
    return root


def envmap(ours):
    """Return the nearest that stock Mitsuba has to a picture of the sky of ours."""
    node = Xml.Element("emitter", type="envmap")
    file = next(each.get("value") for each in ours.iter("string") if each.get("name") == "filename")
    Xml.SubElement(node, "string", name="filename", value=str(Path(file).with_suffix(".pfm")))
    turn = Xml.SubElement(node, "transform", name="to_world")
    Xml.SubElement(turn, "rotate", x="1", angle="90")
    Xml.SubElement(turn, "rotate", z="1", angle="90")
    return node


def lobe(native, threads, kind):
    """Return a function of the seed that renders a native scene the way we do, reading it anew."""
    text = native.read_text().replace('name="band_kind" value="averaged"', f'name="band_kind" value="{kind}"')
    copy = native.with_name(f"{native.stem}-{kind}.xml")

    def render(seed):
        copy.write_text(text.replace('name="seed" value="0"', f'name="seed" value="{seed}"'))
        return renderer().render(copy, RenderOptions(threads), lambda fraction: None).radiance

    return render


def ways(native, samples, threads):
    """Return the variant and the function of the seed of each way, by name."""
    of = partial(stock, native, samples, threads)
    return {
        YARDSTICK: (session.FAST, of(session.FAST, "multijitter")),
        FILM_AS_SHIPPED: (SPECTRAL, of(SPECTRAL, "independent")),
        FILM: (SPECTRAL, of(SPECTRAL, "multijitter")),
        AVERAGED: (session.FAST, lobe(native, threads, "averaged")),
        MEAN: (session.FAST, lobe(native, threads, "mean")),
    }


def measured(found, rounds, threads, clock=time.process_time):
    """Return the fewest seconds by a clock and the pictures of each way, one round after the other."""
    seconds, images = {name: [] for name in found}, {name: [] for name in found}
    for turn in range(rounds + 1):
        for name, (variant, render) in found.items():
            session.start(variant, threads)
            start = clock()
            image = render(turn)
            # The first round compiles, and starts processes.
            if turn:
                seconds[name].append(clock() - start)
                images[name].append(image)
    return {name: min(each) for name, each in seconds.items()}, images


def errors(images):
    """Return the mean and the median over pixels and bands of the relative squared error."""
    # What is nearly black counts for little.
    mean = np.mean(images, axis=0, dtype=float)
    relative = np.var(images, axis=0, ddof=1) / (mean + 0.05 * mean.mean(axis=(0, 1))) ** 2
    return np.array([relative.mean(), np.median(relative)])


def compare(title, native, samples, rounds, threads):
    seconds, images = measured(ways(native, samples, threads), rounds, threads)
    efficiency = {name: 1 / (errors(images[name]) * seconds[name]) for name in seconds if name != YARDSTICK}
    print(
        f"\n| {title}, {samples} samples | time [s] | over rgb | efficiency over specfilm | and as shipped |"
    )
    print("| --- | --- | --- | --- | --- |")
    for name, each in seconds.items():
        cells = ["", ""]
        if name in efficiency:
            ratios = (efficiency[name] / efficiency[other] for other in (FILM, FILM_AS_SHIPPED))
            cells = [f"{mean:.1f} mean, {median:.1f} median" for mean, median in ratios]
        print(f"| {name} | {each:.3f} | {each / seconds[YARDSTICK]:.2f} | {' | '.join(cells)} |")


def family(title, conditions, folder, threads):
    print(
        f"\n| {title}, {FAMILY_SAMPLES} samples"
        " | loading [s] | compiling [s] | rendering [s] | kernels compiled |"
    )
    print("| --- | --- | --- | --- | --- |")
    for name, scene in conditions.items():
        native = renderer().translate(scene, (), folder, title.replace(" ", "-"))
        facts = renderer().render(native, RenderOptions(threads), lambda fraction: None).attributes
        spans = [facts[f"seconds_{what}"] for what in ("loading", "compiling", "rendering")]
        print(f"| {name} | {' | '.join(spans)} | {facts['kernels_compiled']} |")


def main(rounds=6, size=128, threads=1, glossy="metal"):
    if llvm.prepare() is None:
        raise SystemExit("no LLVM works here")
    other = {"tall": lobe_scenes.REFLECTANCES["green"]}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scenes = {"box": lobe_scenes.box, "mesh": partial(lobe_scenes.mesh, picture=lobe_scenes.sky(folder))}
        for title, make in scenes.items():
            native = renderer().translate(make(size, SAMPLES[title], glossy=glossy), (), folder, title)
            compare(title, native, SAMPLES[title], rounds, threads)
        for title, make in scenes.items():
            few = partial(make, size, FAMILY_SAMPLES, glossy=glossy)
            conditions = {
                "the first": few(),
                "the same again": few(),
                "another spectrum": few(changed=other),
                "moved": few(moved=0.2),
                "moved again": few(moved=0.4),
            }
            family(f"a family of the {title}", conditions, folder, threads)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:4]), *sys.argv[4:])
