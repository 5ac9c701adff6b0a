"""What the panels of spectral materials, lights and worlds have in common."""

from __future__ import annotations

from ..operators.use_spectra import RTB_OT_use_spectra


class SpectralPanel:
    """
    A panel of a thing that may have spectra.

    A thing without shows the one button that gives it some; a thing with them can be unticked in the header.
    Blender puts panels of extensions below all of its own, but those without header above them: so this one
    has none and draws its own.
    """

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_options = {"HIDE_HEADER"}
    thing: str  # the context's member that holds the thing

    @classmethod
    def poll(cls, context):
        return getattr(context, cls.thing, None) is not None

    def draw_presets(self, header):
        """Draw the button of presets, where a panel has some."""

    def draw(self, context):
        settings = getattr(context, self.thing).rtb
        header, body = self.layout.panel(self.bl_idname)
        if settings.use_spectra:
            header.prop(settings, "use_spectra", text="")
        header.label(text=self.bl_label)
        if settings.use_spectra:
            self.draw_presets(header)
        if body is None:
            return
        if not settings.use_spectra:
            body.operator(RTB_OT_use_spectra.bl_idname).thing = self.thing.upper()
            return
        body.use_property_split = True
        body.use_property_decorate = False
        self.draw_spectra(body, context, settings)
