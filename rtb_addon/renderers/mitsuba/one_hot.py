"""
A native scene made ready for the lobe path: colours become one-hot, spectra move into tables.

What becomes of materials stands in lobes.py; the spectrum of an emitter becomes the colour (1, 0, 0). No
spectrum is left in the scene that Mitsuba loads.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, field
from xml.etree import ElementTree as Xml

import numpy as np

from ...errors import RenderingError
from ...spectra import FloatArray, Spectrum
from .lobes import Lobe, PictureUse, one_hot_colour, picture_use, take_lobes
from .native import Native
from .xml.lights import ball
from .xml.spectrum import element, parse_spectrum, properties


@dataclass(frozen=True, eq=False)
class Emitter:
    """
    A row of the emitters' table.

    Parameters
    ----------
    spectrum : in the unit of its kind: radiance, radiant intensity or irradiance
    axis : where a spot or a sun shines
    outer, inner : cosines at which a spot's beam has faded out and begins to fade; -2 shines everywhere
    narrowness : 1 - cosine of half the angle of a sun's disc, 0 for everything else
    picture : what multiplies the spectrum of the sky, or None
    turn : (3, 3) array, from the picture's own frame to the world
    """

    spectrum: Spectrum
    axis: tuple[float, float, float] = (0.0, 0.0, 0.0)
    outer: float = -2.0
    inner: float = -2.0
    narrowness: float = 0.0
    picture: PictureUse | None = None
    turn: FloatArray = field(default_factory=lambda: np.eye(3))


@dataclass(frozen=True, eq=False)
class OneHotScene:
    """
    What the lobe path renders.

    Parameters
    ----------
    xml : a scene for Mitsuba's rgb variants without any spectrum
    materials : id of a material -> its lobes; none in the all-bands path
    emitters : id of an emitter -> its row
    wavelengths : (bands x parts,) where materials look up their spectra in the all-bands path [nm]
    """

    xml: str
    materials: dict[str, list[Lobe]]
    emitters: dict[str, Emitter]
    wavelengths: FloatArray | None = None

    @property
    def lobes(self) -> int:
        """Most lobes that a material has."""
        return max((len(lobes) for lobes in self.materials.values()), default=1)

    @property
    def metals(self) -> int:
        """Most lobes of metals that a material has; they are its first."""
        counts = (sum(lobe.index is not None for lobe in lobes) for lobes in self.materials.values())
        return max(counts, default=0)


def one_hot(native: Native) -> OneHotScene:
    """Return a native scene ready for the lobe path; BeyondLobes where a material is more than that."""
    root, beams = bare(native)
    materials = take_lobes(root)
    emitters = take_emitters(root, native, beams)
    return OneHotScene(Xml.tostring(root, encoding="unicode"), materials, emitters)


def bare(native: Native) -> tuple[Xml.Element, dict[str, dict]]:
    """Return a copy of a native scene without what only stock Mitsuba reads, and the beams of its spots."""
    root = copy.deepcopy(native.root)
    for node in [child for child in root if child.tag in ("default", "integrator")]:
        root.remove(node)
    _swap_film(root, native)
    _make_files_absolute(root, native)
    return root, _swap_spots(root, native)


def take_emitters(root: Xml.Element, native: Native, beams: dict[str, dict]) -> dict[str, Emitter]:
    """Replace the spectra of all emitters by one-hot colours; return their rows by emitter."""
    return {_id(node): _take_emitter(node, native, beams) for node in root.iter("emitter")}


def _swap_film(root: Xml.Element, native: Native) -> None:
    """Give the camera a film of the same size that rgb variants know; nothing is ever written to it."""
    for sensor in root.iter("sensor"):
        # How many samples are taken, and from which seed, is told later, round by round.
        for count in sensor.iterfind("sampler/integer"):
            count.set("value", "4")
        for film in sensor.findall("film"):
            sensor.remove(film)
        film = element("film", "hdrfilm", width=native.width, height=native.height)
        film.append(element("rfilter", "box"))
        sensor.append(film)


def _make_files_absolute(root: Xml.Element, native: Native) -> None:
    for node in root.iter("string"):
        if node.get("name") == "filename":
            node.set("value", str((native.path.parent / node.get("value", "")).resolve()))


def _swap_spots(root: Xml.Element, native: Native) -> dict[str, dict]:
    """Turn spots into points or spheres and return their beams, which the lobe path applies itself."""
    beams = {}
    for node in [child for child in root if child.get("type") == "spot"]:
        values, place, to_world = properties(node), _id(node), _matrix(node)
        beams[place] = {
            "axis": tuple(float(x) for x in to_world[:3, 2]),
            "outer": math.cos(math.radians(float(values["cutoff_angle"]))),
            "inner": math.cos(math.radians(float(values["beam_width"]))),
        }
        for child in [child for child in node if child.get("name") in ("cutoff_angle", "beam_width")]:
            node.remove(child)
        node.set("type", "point")
        radius = float(native.defaults.get(f"{place}_radius", 0.0))
        if radius:
            _round_out(root, node, to_world[:3, 3], radius)
    return beams


def _round_out(root: Xml.Element, spot: Xml.Element, centre: FloatArray, radius: float) -> None:
    """Put a sphere in the place of a spot: its radiance in a direction is the intensity over pi r^2."""
    spectrum = next(spot.iter("spectrum"))
    values = parse_spectrum(spectrum).scaled(1 / (math.pi * radius**2))
    radiance = element(
        "spectrum",
        "irregular",
        name="radiance",
        wavelengths=" ".join(map(repr, values.wavelengths.tolist())),
        values=" ".join(map(repr, values.values.tolist())),
    )
    root.remove(spot)
    root.append(ball(_id(spot), centre, radius, radiance))


def _take_emitter(node: Xml.Element, native: Native, beams: dict[str, dict]) -> Emitter:
    place, spectrum = _id(node), _take_spectrum(node)
    if (picture := node.find("texture[@type='picture']")) is not None:
        # Where the light is still decides where paths look for it.
        node.append(Xml.Element("boolean", name="even", value="true"))
        return Emitter(spectrum, picture=picture_use(picture), turn=_matrix(node)[:3, :3])
    angle = math.radians(float(native.defaults.get(f"{place}_angle", 0.0)))
    if not angle:
        return Emitter(spectrum, **beams.get(place, {}))
    # 1 - cos, without the loss of digits that a small disc would suffer.
    return Emitter(spectrum, _direction(node), narrowness=2 * math.sin(angle / 4) ** 2)


def _take_spectrum(emitter: Xml.Element) -> Spectrum:
    """Replace an emitter's spectrum by a one-hot colour, and return it."""
    if emitter.find("rgb") is not None or any(not node.get("type") for node in emitter.findall("spectrum")):
        raise RenderingError(f"the native scene's {_id(emitter)} has a colour, write a regular spectrum")
    spectra = emitter.findall("spectrum")
    if len(spectra) != 1:
        raise RenderingError(f"the native scene's {_id(emitter)} has {len(spectra)} spectra, give it one")
    emitter[list(emitter).index(spectra[0])] = one_hot_colour(spectra[0].get("name", ""), 0)
    return parse_spectrum(spectra[0])


def _matrix(node: Xml.Element) -> FloatArray:
    for found in node.iter("matrix"):
        return np.array([float(word) for word in found.get("value", "").split()]).reshape(4, 4)
    return np.eye(4)


def _direction(node: Xml.Element) -> tuple[float, float, float]:
    vector = next(child for child in node if child.get("name") == "direction")
    x, y, z = (float(vector.get(axis, 0)) for axis in "xyz")
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def _id(node: Xml.Element) -> str:
    return node.get("id", node.get("type", ""))
