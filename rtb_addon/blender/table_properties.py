"""What a scene keeps of its recipe's table and mappings: variables, conditions, properties that vary."""

import bpy
from bpy import props

_FILES = (".spd", ".csv", ".mat", ".txt")  # whose folders say where they lie
KINDS = (
    ("TEXT", "Text", "Anything that is typed", 1),
    ("NUMBER", "Number", "A number", 2),
    ("COLOUR", "Colour", "Red, green and blue; a spectrum that shows it where a spectrum is wanted", 3),
    ("SPECTRUM", "Spectrum", "A spectrum, with the menu of spectra", 4),
    ("OBJECT", "Object", "The name of an object of this file", 5),
)


def numbers_of(text: str) -> list[float]:
    """Return the numbers of a cell, none where it holds anything else."""
    try:
        return [float(word) for word in text.replace(",", " ").split()]
    except ValueError:
        return []


def row_chosen(group, context) -> None:
    """Let the preview follow what a condition says."""
    from . import preview

    preview.refresh()


def _number(cell) -> float:
    found = numbers_of(cell.value)
    return found[0] if len(found) == 1 else 0.0


def _set_number(cell, value: float) -> None:
    cell.value = in_digits(value)


def _colour(cell) -> tuple[float, ...]:
    found = numbers_of(cell.value)
    return tuple(found) if len(found) == 3 else (0.0, 0.0, 0.0)


def _set_colour(cell, value) -> None:
    cell.value = " ".join(map(in_digits, value))


def _short(cell) -> str:
    name = cell.value.rpartition("/")[2]
    return name if name and not name.lower().endswith(_FILES) else cell.value


def _set_short(cell, text: str) -> None:
    if text == _short(cell):
        return
    from ..spectra.library import names  # brings numpy, which enabling need not wait for
    from .own_spectra import own_folders

    beside = f"{cell.value.rpartition('/')[0]}/{text}"
    cell.value = beside if beside in names(own_folders()) else text


def spoken_cell(variable, text: str) -> str:
    """Return a cell as it would be typed for a spectrum: a colour as a spectrum that shows it."""
    numbers = numbers_of(text)
    if variable.kind != "COLOUR" or len(numbers) != 3:
        return text
    from .principled import in_words  # brings numpy, which enabling need not wait for

    return in_words((numbers[0], numbers[1], numbers[2]))


def in_digits(value: float) -> str:
    """Return a number of single precision with as many digits as tell it from others, at most seven."""
    for digits in range(1, 9):
        text = f"{value:.{digits}g}"
        if abs(float(text) - value) <= 6e-8 * abs(value):
            return text
    return f"{value:.9g}"


class RTB_PG_cell(bpy.types.PropertyGroup):
    """What one condition says for one variable: a text, of which there are other views."""

    value: props.StringProperty(name="Value", description="Text of this cell", update=row_chosen)
    number: props.FloatProperty(name="Value", description="Number of this cell", get=_number, set=_set_number)
    colour: props.FloatVectorProperty(
        name="Value", description="Colour of this cell", subtype="COLOR", min=0.0, max=1.0,
        get=_colour, set=_set_colour,
    )  # fmt: skip
    short: props.StringProperty(
        name="Value",
        description="Spectrum of this cell, without its chart's name; so is another one of that chart called",
        get=_short, set=_set_short,
    )  # fmt: skip


class RTB_PG_variable(bpy.types.PropertyGroup):
    """A column of the conditions; its name is what (name) stands for."""

    kind: props.EnumProperty(name="Type", description="What its cells hold", items=KINDS, default="TEXT")


class RTB_PG_condition(bpy.types.PropertyGroup):
    """A row of the conditions; its name names its files. Cells are in the order of the variables."""

    cells: props.CollectionProperty(type=RTB_PG_cell)
    # What a file that was saved tells of its rendering: name, cells and options then.
    rendered: props.StringProperty(options={"HIDDEN"})


class RTB_PG_mapping(bpy.types.PropertyGroup):
    """A property of something in the file that conditions set; its name is how sentences call it."""

    thing: props.PointerProperty(type=bpy.types.ID, name="Thing", description="What has the property")
    path: props.StringProperty(
        name="Property", description="Path of the property, as Blender's drivers write it"
    )
    index: props.IntProperty(
        name="Component", description="Of a vector, from 0; -1 for all of it", default=-1, min=-1
    )
    value: props.StringProperty(
        name="Value",
        description="What it is set to: (variable), or arithmetic such as 2 * (distance); angles in degrees",
        update=row_chosen,
    )


class RTB_PG_kept(bpy.types.PropertyGroup):
    """What a property was before the preview of a condition, and what that has set it to."""

    thing: props.PointerProperty(type=bpy.types.ID)
    path: props.StringProperty()
    index: props.IntProperty(default=-1)
    was: props.StringProperty()
    was_thing: props.PointerProperty(type=bpy.types.ID)
    shown: props.StringProperty()
    shown_thing: props.PointerProperty(type=bpy.types.ID)


CLASSES = (RTB_PG_cell, RTB_PG_variable, RTB_PG_condition, RTB_PG_mapping, RTB_PG_kept)
