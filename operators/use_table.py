"""A spectrum as numbers in a table."""

import bpy

from ..rtb_addon.blender.fields import FIELDS, owner_of, typed_in
from ..rtb_addon.blender.own_spectra import heard
from ..rtb_addon.errors import RecipeError
from .spectrum_dialogs import SpectrumDialog

MOST, ROWS = 40, 16  # samples of a dialog, and of one part of it; finer spectra are files
NUMBERS = 0.66  # of the width; the rest is the curve's


class RTB_PG_sample(bpy.types.PropertyGroup):
    """One row of a spectrum's table."""

    wavelength: bpy.props.FloatProperty(
        name="Wavelength (nm)", default=550.0, min=1.0, precision=1, step=1000
    )
    value: bpy.props.FloatProperty(name="Value", precision=4, step=1)


def _fitted(operator, _context) -> None:
    """Let there be as many rows as are asked for, new ones beyond the last."""
    samples = operator.samples
    while len(samples) > operator.count:
        samples.remove(len(samples) - 1)
    while len(samples) < operator.count:
        last = samples[-1] if samples else None
        wavelength, value = (380.0, 0.5) if last is None else (last.wavelength + 20, last.value)
        new = samples.add()
        new.wavelength, new.value = wavelength, value


class RTB_OT_use_table(SpectrumDialog, bpy.types.Operator):
    """A spectrum as wavelengths and values, straight lines between them"""

    bl_idname = "rtb.use_table"
    bl_label = "Table"

    count: bpy.props.IntProperty(name="Samples", default=0, min=0, max=MOST, update=_fitted)
    samples: bpy.props.CollectionProperty(type=RTB_PG_sample)

    width = 520

    def begin(self, context, text):
        spectrum = self.now(context)
        self.samples.clear()
        for wavelength, value in zip(spectrum.wavelengths, spectrum.values, strict=True):
            sample = self.samples.add()
            sample.wavelength, sample.value = wavelength, value
        self.count = len(self.samples)

    def now(self, context):
        """Return what the field says now, in no more rows than fit."""
        # numpy takes longer to come than all else that enabling the extension waits for.
        from ..rtb_addon.spectra import Spectrum

        group = owner_of(context, self.field)
        spectrum = heard(typed_in(group, FIELDS[self.field].name, context.scene.rtb))
        if len(spectrum.wavelengths) <= MOST:
            return spectrum
        places = [*range(380, 781, 20)]
        return Spectrum.of(places, spectrum.at(places))

    def draw(self, context):
        self.layout.prop(self, "count")
        # Long tables stand in two parts beside each other, so that they fit on a small screen.
        half = len(self.samples) if len(self.samples) <= ROWS else -(-len(self.samples) // 2)
        sides = self.layout.split(factor=NUMBERS)
        parts = sides.row()
        for part in filter(None, (self.samples[:half], self.samples[half:])):
            column = parts.column(align=True)
            heads = column.row(align=True)
            for head in ("Wavelength (nm)" if half == len(self.samples) else "nm", "Value"):
                heads.label(text=head)
            for sample in part:
                row = column.row(align=True)
                row.prop(sample, "wavelength", text="")
                row.prop(sample, "value", text="")
        self.draw_becomes(sides.column(), context)

    def text(self, context, owner):
        rows = sorted((each.wavelength, each.value) for each in self.samples)
        if not rows:
            raise RecipeError("the table is empty, a spectrum needs at least one sample")
        if len({wavelength for wavelength, _ in rows}) < len(rows):
            raise RecipeError("two rows of the table have the same wavelength, give each its own")
        return " ".join(f"{wavelength:.6g}:{value:.6g}" for wavelength, value in rows)
