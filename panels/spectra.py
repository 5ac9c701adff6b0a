"""What the panels of spectral materials, lights, worlds and emitting meshes have in common."""

from __future__ import annotations

from ..operators.use_spectra import RTB_OT_use_spectra


class SpectralPanel:
    """
    A panel of a thing that may have spectra.

    A thing without shows the one button that gives it some; a thing with them can be unticked in the header.
    """

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    thing: str  # the context's member that holds the thing

    @classmethod
    def poll(cls, context):
        return getattr(context, cls.thing, None) is not None

    def draw_header(self, context):
        settings = getattr(context, self.thing).rtb
        if settings.use_spectra:
            self.layout.prop(settings, "use_spectra", text="")

    def draw(self, context):
        settings = getattr(context, self.thing).rtb
        if not settings.use_spectra:
            self.layout.operator(RTB_OT_use_spectra.bl_idname).thing = self.thing.upper()
            return
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.draw_spectra(self.layout, settings)
