"""What verbs that ask for a spectrum in a dialog have in common: the curve of what they will write."""

from __future__ import annotations

from ..rtb_addon.blender import curve_previews
from ..rtb_addon.blender.fields import FIELDS, owner_of
from ..rtb_addon.errors import RecipeError
from .spectrum_verbs import SpectrumVerb

UNITS = 8  # side of a curve, in units of Blender's layouts


class SpectrumDialog(SpectrumVerb):
    """A verb with a dialog, which begins with what the field says now and shows what becomes of it."""

    width = 260
    # What is shown and why nothing is: made where something was changed, and not while drawing.
    said: tuple[str, str] = ("", "")

    def invoke(self, context, event):
        try:
            self.begin(context, getattr(owner_of(context, self.field), FIELDS[self.field].name))
        except RecipeError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.check(context)
        return context.window_manager.invoke_props_dialog(self, width=self.width, confirm_text="Use")

    def begin(self, context, text: str) -> None:
        """Take over what a field says, where this verb can."""

    def check(self, context):
        """Show what was changed; Blender asks after each change."""
        try:
            self.said = self.text(context, None), ""
            curve_previews.show_now(*self.picture(context))
        except RecipeError as error:
            self.said = "", str(error)
        return True

    def picture(self, context) -> tuple[str, bool, int, str]:
        """Return which picture of a curve is shown."""
        field, side = FIELDS[self.field], curve_previews.side_of(UNITS, context)
        return self.said[0], field.shines, side, "" if field.index else context.scene.rtb.seen_under

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.draw_asked(self.layout)
        self.draw_becomes(self.layout, context)

    def draw_becomes(self, layout, context) -> None:
        """Draw the curve of what is asked for, or why there is none."""
        text, sentence = self.said
        shown = curve_previews.shown(*self.picture(context)) if text else curve_previews.Shown(0, sentence)
        if shown.sentence:
            layout.label(text=shown.sentence, icon="ERROR")
        elif shown.icon:
            layout.template_icon(icon_value=shown.icon, scale=UNITS)

    def draw_asked(self, layout) -> None:
        """Draw what is asked for."""
        layout.prop(self, self.asked)
