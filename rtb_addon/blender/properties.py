"""What RenderToolbox keeps in a .blend file: real properties of scenes, materials, lamps, worlds, objects."""

import atexit
from collections.abc import Iterable, Sequence

import bpy
from bpy.props import (
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from . import renderer_choices, table_properties
from .conditions import set_conditions
from .light_properties import RTB_PG_light, RTB_PG_object, RTB_PG_world
from .material_properties import RTB_PG_material, RTB_PG_texture
from .redrawing import redraw_panels
from .table_properties import RTB_PG_condition, RTB_PG_kept, RTB_PG_mapping, RTB_PG_variable

INTEGRATORS = (
    ("path", "Path", "Light that is reflected many times", 1),
    ("direct", "Direct", "Light that comes straight from a lamp", 2),
)
UNITS = (
    ("si", "SI", "A point light's numbers are W / (sr nm)", 1),
    ("rtb3", "RenderToolbox3", "Total power", 2),
)
HANDEDNESS = (
    ("blender", "Blender", "Pictures show what the camera shows", 1),
    ("rtb3", "RenderToolbox3", "Pictures are mirrored unless a mapping flips the camera", 2),
)
FILTERS = (
    ("box", "Box", "Each path counts for the pixel that it goes through", 1),
    ("tent", "Tent", "Falls straight to nothing within a pixel", 2),
    ("gaussian", "Gaussian", "Half a pixel wide, cut off at two pixels", 3),
    ("mitchell", "Mitchell", "Sharper than a Gaussian, with little ringing", 4),
    ("catmullrom", "Catmull-Rom", "Sharp, with some ringing", 5),
    ("lanczos", "Lanczos", "Sharpest, with three lobes of ringing", 6),
)
BAND_KINDS = (
    ("averaged", "Averaged", "Each spectrum is averaged over a band, then multiplied along the path", 1),
    ("mean", "Mean", "The true mean over a band of what comes out", 2),
    ("centre", "Centre", "The values at a band's centre", 3),
)
LAYERS = tuple(
    (name, label, words, 2**number)
    for number, (name, label, words) in enumerate(
        (
            ("depth", "Depth", "How far what is seen lies ahead (m)"),
            ("normal", "Normals", "Which way surfaces face in the world"),
            ("uv", "Texture Coordinates", "Where in its UV map a surface is seen"),
            ("object", "Objects", "A number for each object, with the names"),
            ("material", "Materials", "A number for each material, with the names"),
            ("albedo", "Albedo", "Reflectance of what is seen, in each band"),
            ("direct", "Direct Light", "Radiance of light that comes straight from lamps"),
            ("indirect", "Indirect Light", "Radiance of all other light"),
            ("standard_error", "Standard Errors", "How uncertain each radiance is, for a view of it"),
        )
    )
)
FILLS = (
    ("columns", "Down the Columns", "Conditions go down the columns, as in RenderToolbox3", 1),
    ("rows", "Along the Rows", "Conditions go along the rows, as the patches of a chart", 2),
)
SWATCH_LIGHTS = tuple(
    (name, f"{name} ({words})", "", number)
    for number, (name, words) in enumerate(
        {
            "D65": "Noon Daylight",
            "D50": "Morning Daylight",
            "A": "Incandescent",
            "E": "Equal Energy",
            "FL2": "Cool White Fluorescent",
            "FL11": "Narrow Band Fluorescent",
            "HP1": "Sodium",
            "LED-B3": "White LED",
        }.items(),
        1,
    )
)


def rendered_size(scene) -> tuple[int, int]:
    """Return the width and height that Blender renders a scene with [pixels]."""
    render = scene.render
    part = render.resolution_percentage
    return max(render.resolution_x * part // 100, 1), max(render.resolution_y * part // 100, 1)


def montage_arranged(settings, context) -> None:
    """Let panels be drawn anew; without an update of its own Blender tells nobody of a change by a script."""
    redraw_panels()


def _resize(render, width: int, height: int) -> None:
    render.resolution_percentage = 100
    render.resolution_x, render.resolution_y = width, height


class RTB_PG_scene(bpy.types.PropertyGroup):
    """The recipe of a scene; its width and height are those that Blender renders with."""

    # Files from before it was written down have none, and are of the first one.
    schema: IntProperty(name="Schema", default=1, options={"HIDDEN"})
    name: StringProperty(name="Name", description="Name of the recipe; empty: that of the .blend file")
    folder: StringProperty(
        name="Folder",
        description="Where the recipe is written; NAME stands for its name, // for the folder of the .blend",
        default="//rtb/NAME/",
        subtype="DIR_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
    )
    renderer: EnumProperty(name="Renderer", items=renderer_choices.choices, default=1)
    samples: IntProperty(name="Samples", description="Light paths per pixel", default=64, min=1)
    until_error: FloatProperty(
        name="Until Noise",
        description="Stop once the relative noise is this low, even before all samples; 0 takes them all",
        default=0.0,
        min=0.0,
        soft_max=0.1,
        precision=3,
    )
    seed: IntProperty(name="Seed", description="Of the random numbers, for all conditions", min=0)
    filter: EnumProperty(name="Filter", items=FILTERS, default="box")
    integrator: EnumProperty(name="Light Paths", items=INTEGRATORS, default="path")
    depth: IntProperty(
        name="Depth", description="Longest light path; 2 is direct light", default=6, min=1, soft_max=64
    )
    bands_start: FloatProperty(name="First Band (nm)", default=400.0, min=1.0, precision=1)
    bands_step: FloatProperty(name="Band Width (nm)", default=10.0, min=0.01, precision=1)
    band_kind: EnumProperty(name="Band Values", items=BAND_KINDS, default="averaged")
    layers: EnumProperty(
        name="Layers",
        description="What each condition's file of layers holds beside its cube",
        items=LAYERS,
        options={"ENUM_FLAG"},
    )
    bands_count: IntProperty(name="Bands", default=31, min=1, soft_max=100)
    montage_columns: IntProperty(
        name="Montage Columns",
        description="0: as square as may be",
        default=0,
        min=0,
        update=montage_arranged,
    )
    montage_fill: EnumProperty(name="Montage Order", items=FILLS, default="columns", update=montage_arranged)
    variables: CollectionProperty(type=RTB_PG_variable)
    conditions: CollectionProperty(type=RTB_PG_condition)
    mappings: CollectionProperty(type=RTB_PG_mapping)
    mappings_text: PointerProperty(
        type=bpy.types.Text, name="Further Mappings", description="Mappings in the words of RenderToolbox3"
    )
    kept: CollectionProperty(type=RTB_PG_kept)
    # Of a recipe that was opened: what its numbers mean, where its spectra lie, options that have no button.
    units: EnumProperty(items=UNITS, default="si", options={"HIDDEN"})
    handedness: EnumProperty(items=HANDEDNESS, default="blender", options={"HIDDEN"})
    resources: StringProperty(
        name="Resources",
        description="Folder of the files that written mappings and cells name",
        subtype="DIR_PATH",
    )
    further: StringProperty(options={"HIDDEN"})
    active_mapping: IntProperty(options={"HIDDEN", "SKIP_SAVE"}, min=0)
    seen_under: EnumProperty(
        name="Swatches Under", description="The light that swatches show surfaces in", items=SWATCH_LIGHTS
    )
    active_variable: IntProperty(options={"HIDDEN", "SKIP_SAVE"}, min=0)
    active_condition: IntProperty(options={"HIDDEN", "SKIP_SAVE"}, min=0, update=table_properties.row_chosen)

    # Kept in one place, with the render settings: no properties of Blender's.
    @property
    def width(self) -> int:
        """Width of the pictures [pixels]."""
        return rendered_size(self.id_data)[0]

    @width.setter
    def width(self, value: int) -> None:
        _resize(self.id_data.render, value, self.height)

    @property
    def height(self) -> int:
        """Height of the pictures [pixels]."""
        return rendered_size(self.id_data)[1]

    @height.setter
    def height(self, value: int) -> None:
        _resize(self.id_data.render, self.width, value)

    def set_conditions(self, variables: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
        """Replace the table of conditions by rows of cells, one cell for each variable."""
        set_conditions(self.id_data, variables, rows)


_CLASSES = (
    *table_properties.CLASSES,
    RTB_PG_scene,
    RTB_PG_texture,
    RTB_PG_material,
    RTB_PG_light,
    RTB_PG_world,
    RTB_PG_object,
)
_POINTERS = (
    ("Scene", RTB_PG_scene),
    ("Material", RTB_PG_material),
    ("Light", RTB_PG_light),
    ("World", RTB_PG_world),
    ("Object", RTB_PG_object),
)


def register() -> None:
    """Make the properties known to Blender; again, where they are known already, does nothing."""
    if hasattr(bpy.types.Scene, "rtb") and all(cls.is_registered for cls in _CLASSES):
        return
    unregister()
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    for name, cls in _POINTERS:
        getattr(bpy.types, name).rtb = PointerProperty(type=cls, override={"LIBRARY_OVERRIDABLE"})
    if bpy.app.module:  # as a Python module, Blender hangs at its end while it knows classes of ours
        atexit.unregister(unregister)
        atexit.register(unregister)


def unregister() -> None:
    """Take the properties back, those that are there; what a file holds stays in it."""
    for name, _ in reversed(_POINTERS):
        if hasattr(owner := getattr(bpy.types, name), "rtb"):
            del owner.rtb
    for cls in reversed(_CLASSES):
        if cls.is_registered:
            bpy.utils.unregister_class(cls)
