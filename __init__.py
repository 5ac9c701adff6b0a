"""RenderToolbox: physically based, multispectral families of stimuli for vision science."""


def register():
    from . import operators, panels
    from .rtb_addon.blender import properties

    for room in (properties, operators, panels):
        room.register()


def unregister():
    from . import operators, panels
    from .rtb_addon.blender import properties

    for room in (panels, operators, properties):
        room.unregister()
