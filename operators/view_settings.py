"""How renderings are looked at, and pins in them: of the window, hence neither saved nor undone."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..rtb_addon.blender.renderer_choices import choices
from . import row_states, viewing

KINDS = (
    ("srgb", "sRGB", "As the renderings appear", 1),
    ("wavelength", "Wavelength", "The radiance of one band, in grey", 2),
    ("luminance", "Luminance", "Luminance in false colours", 3),
    (
        "difference",
        "Difference",
        "How far each spectrum is from that of another condition, in false colours",
        4,
    ),
    ("error", "Standard Error", "How uncertain each spectrum is, in false colours", 5),
)
# Blender reads a list of choices where we keep it.
_renderers = [("recipe", "The Recipe's", "Whatever the recipe is rendered by", 0)]


def _changed(view, context) -> None:
    viewing.refresh(context.scene)


def _scale_taken_over(view, context) -> None:
    """Begin with the scale that the picture has."""
    if not view.auto_scale and viewing.seen:
        setattr(view, view.scale_name, viewing.seen["full"])
    else:
        _changed(view, context)


def _renderers_offered(view, context) -> list[tuple[str, str, str, int]]:
    _renderers[1:] = choices(view, context)
    return _renderers


def _conditions(view, context, typed: str) -> list[str]:
    scene = context.scene
    rows = enumerate(scene.rtb.conditions)
    return [
        name
        for number, row in rows
        if typed.lower() in (name := row_states.row_name(scene, row, number)).lower()
    ]


class RTB_PG_view(bpy.types.PropertyGroup):
    """How renderings are looked at in the Image Editor."""

    condition: StringProperty(
        name="Condition",
        description="The one to show; empty: all of them",
        search=_conditions,
        update=_changed,
    )
    kind: EnumProperty(name="View", items=KINDS, default="srgb", update=_changed)
    wavelength: FloatProperty(
        name="Wavelength (nm)",
        description="The band nearest to it is shown",
        default=550.0,
        min=1.0,
        soft_min=380.0,
        soft_max=780.0,
        step=1000,
        precision=0,
        update=_changed,
    )
    other: StringProperty(
        name="Compared To",
        description="Root mean square over the bands of the difference to this condition",
        search=_conditions,
        update=_changed,
    )
    auto_scale: BoolProperty(
        name="Automatic Scale",
        description="White, or the last colour, is what is brightest in the picture",
        default=True,
        update=_scale_taken_over,
    )
    full_luminance: FloatProperty(
        name="White at (cd/m²)",
        description="Luminance that is shown white",
        default=100.0,
        min=1e-9,
        soft_max=1e5,
        precision=3,
        update=_changed,
    )
    full_radiance: FloatProperty(
        name="White at (W/sr/m²/nm)",
        description="Radiance, in W / (sr m² nm), that is shown white",
        default=1.0,
        min=1e-12,
        soft_max=1e3,
        precision=5,
        update=_changed,
    )
    renderer: EnumProperty(name="Renderer", items=_renderers_offered, default=0, update=_changed)

    @property
    def scale_name(self) -> str:
        """Which property is the scale of this view."""
        return "full_luminance" if self.kind in ("srgb", "luminance") else "full_radiance"

    def request(self) -> dict:
        """Return what a request for a picture says of the view."""
        full = None if self.auto_scale else getattr(self, self.scale_name)
        return {
            "renderer": "" if self.renderer == "recipe" else self.renderer,
            "condition": self.condition,
            "other": self.other,
            "view": {"kind": self.kind, "wavelength": self.wavelength, "full": full},
        }


class RTB_PG_pin(bpy.types.PropertyGroup):
    """A probe that is kept; its name says where it lies."""

    number: IntProperty(name="Number", description="That the picture shows beside it")
    colour: FloatVectorProperty(name="Colour", subtype="COLOR_GAMMA", size=3, min=0.0, max=1.0)
    first: IntProperty(name="Compared To", description="Number of the pin that it is compared to, or 0")
    folder: StringProperty(name="Recipe", description="Folder of the recipe that it was measured in")
    words: StringProperty(name="Probe", description="What was measured, as JSON")


def register() -> None:
    """Make them known to Blender."""
    for cls in (RTB_PG_view, RTB_PG_pin):
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.rtb_view = PointerProperty(type=RTB_PG_view)
    bpy.types.WindowManager.rtb_pins = CollectionProperty(type=RTB_PG_pin)
    bpy.types.WindowManager.rtb_active_pin = IntProperty(options={"HIDDEN"}, min=0)


def unregister() -> None:
    """Take them back."""
    for name in ("rtb_active_pin", "rtb_pins", "rtb_view"):
        delattr(bpy.types.WindowManager, name)
    for cls in (RTB_PG_pin, RTB_PG_view):
        bpy.utils.unregister_class(cls)
