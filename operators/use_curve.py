"""A spectrum drawn as a curve, by Blender's own widget for curves."""

import bpy

from ..rtb_addon.blender.fields import FIELDS, owner_of, typed_in
from ..rtb_addon.blender.own_spectra import heard
from ..rtb_addon.errors import RecipeError
from .spectrum_dialogs import SpectrumDialog

FIRST, LAST = 380, 780  # [nm]; Blender's widget shows them as 0 and 1
APART, STEP = 25, 10  # points to begin with, and samples that are written [nm]
NAME = ".Spectrum"  # of the nodes that hold the curve while the dialog is open; a dot hides them


class RTB_OT_use_curve(SpectrumDialog, bpy.types.Operator):
    """A smooth curve through points that you drag; click between them for a new one"""

    bl_idname = "rtb.use_curve"
    bl_label = "Curve"
    width = 360

    highest: bpy.props.FloatProperty(
        name="Highest Value", description="Of the frame", default=1.0, min=1e-6, soft_max=10.0, precision=3
    )
    pairs: bpy.props.StringProperty(
        name="Pairs", description="What was drawn, wavelengths [nm] and values", options={"HIDDEN"}
    )

    def begin(self, context, text):
        # numpy takes longer to come than all else that enabling the extension waits for.
        from ..rtb_addon.curves import nice_above

        group = owner_of(context, self.field)
        spectrum = heard(typed_in(group, FIELDS[self.field].name, context.scene.rtb))
        self.forget()
        tree = bpy.data.node_groups.new(NAME, "ShaderNodeTree")
        mapping = tree.nodes.new("ShaderNodeFloatCurve").mapping
        places = [*range(FIRST, LAST + 1, APART)]
        values = spectrum.at(places)
        self.highest = nice_above(float(values.max()))
        lay(mapping, [(place - FIRST) / (LAST - FIRST) for place in places], values / self.highest)

    def text(self, context, owner):
        if (mapping := held()) is not None:
            self.pairs = drawn(mapping, self.highest)
        if not self.pairs:
            raise RecipeError("nothing has been drawn, give pairs like 400:0.2 700:0.8")
        return self.pairs

    def draw_asked(self, layout):
        layout.prop(self, "highest")
        if tree := bpy.data.node_groups.get(NAME):
            layout.template_curve_mapping(tree.nodes[0], "mapping")

    def execute(self, context):
        finished = super().execute(context)
        self.forget()
        return finished

    def cancel(self, context):
        self.forget()

    def forget(self) -> None:
        """Take the nodes away."""
        if tree := bpy.data.node_groups.get(NAME):
            bpy.data.node_groups.remove(tree)


def held():
    """Return the curve that is being drawn, or None."""
    tree = bpy.data.node_groups.get(NAME)
    return None if tree is None else tree.nodes[0].mapping


def lay(mapping, places, values) -> None:
    """Lay a curve through values at places, all of them from 0 to 1."""
    curve = mapping.curves[0]
    first, *between, last = zip(places, values, strict=True)
    curve.points[0].location, curve.points[-1].location = first, last
    for place, value in between:
        curve.points.new(place, value)
    for point in curve.points:
        point.handle_type, point.select = "AUTO_CLAMPED", False
    mapping.use_clip = True
    mapping.update()


def drawn(mapping, highest: float) -> str:
    """Return the pairs of a curve, whose bows may lie a little below 0, where no light is."""
    curve = mapping.curves[0]
    places = range(FIRST, LAST + 1, STEP)
    values = [mapping.evaluate(curve, (place - FIRST) / (LAST - FIRST)) for place in places]
    return " ".join(
        f"{place}:{max(value, 0) * highest:.4g}" for place, value in zip(places, values, strict=True)
    )
