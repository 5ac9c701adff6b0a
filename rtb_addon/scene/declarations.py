"""What a recipe declares: materials, lights and textures in the words of the vocabulary."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from ..errors import RecipeError, choices
from .adjustments import NeutralObject, Property, Remark
from .render_scene import Value
from .values import Values
from .vocabulary import CATEGORIES, Parameter

# Switches of old renderers that mean nothing to a renderer that takes reflectances as they are.
_IGNORED = ("ensureEnergyConservation",)


@dataclass(frozen=True)
class Declaration:
    """
    A material, light or texture, from all the blocks that speak of it.

    Parameters
    ----------
    category, model : as declared
    said : parameter -> the property that sets it last
    file, line : where it is declared
    """

    id: str
    category: str
    model: str
    said: Mapping[str, Property]
    file: str
    line: int

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The parameters of its model."""
        return CATEGORIES[self.category][self.model]

    def error(self, message: str) -> RecipeError:
        """Return an error at the place of the declaration."""
        return RecipeError(message, self.file, self.line)


def declarations(objects: Iterable[NeutralObject], values: Values) -> dict[str, Declaration]:
    """
    Return what is declared, by id.

    A block that declares an id again begins it anew, as RenderToolbox3 filled in its defaults again; a
    block that only sets properties adds to what is there.
    """
    found: dict[str, Declaration] = {}
    for each in objects:
        if each.category:
            _refuse_unknown(each)
            declared = Declaration(each.id, each.category, each.model, {}, each.file, each.line)
            values.warnings.extend(_forgotten(each, found.get(each.id)))
        elif each.id in found:
            declared = found[each.id]
        else:
            message = f"{each.id} is not declared, add a line such as {each.id}:material:matte before it"
            raise RecipeError(message, each.file, each.line)
        found[each.id] = _with_properties(declared, each.properties, values)
    return found


def parameters_of(
    declared: Declaration, values: Values, given: Mapping[str, Value] | None = None
) -> dict[str, Value]:
    """Return every parameter of a declaration: what it says, else what is given, else the default."""
    chosen: dict[str, Value] = {}
    for name, parameter in declared.parameters.items():
        default = parameter.default_value()
        if name in declared.said:
            chosen[name] = values.read(declared.id, parameter, declared.said[name])
        elif given and name in given:
            chosen[name] = given[name]
        elif default is not None:
            chosen[name] = default
        elif parameter.kind == "spectrum" and isinstance(parameter.default, str):
            unsaid = Property(name, "spectrum", parameter.default, declared.file, declared.line)
            chosen[name] = values.read(declared.id, parameter, unsaid)
        else:
            raise declared.error(f"{declared.id} must say its {name}, {declared.model} has no default for it")
    return chosen


def _forgotten(each: NeutralObject, before: Declaration | None) -> Iterable[str]:
    """Yield what to say where a declaration takes back what an earlier one said."""
    again = {said.name for said in each.properties}
    lost = [name for name in before.said if name not in again and name in before.parameters] if before else []
    if before and lost:
        message = f"{each.id} is declared again, so {', '.join(lost)} of line {before.line} no longer counts"
        yield str(Remark(message, each.file, each.line))


def _refuse_unknown(each: NeutralObject) -> None:
    if each.category not in CATEGORIES:
        message = f"{each.id} is declared a {each.category}, want one of {choices(each.category, CATEGORIES)}"
        raise RecipeError(message, each.file, each.line)
    models = CATEGORIES[each.category]
    if each.model not in models:
        known = choices(each.model, models, len(models))
        raise RecipeError(
            f"no {each.category} is called {each.model}, want one of {known}", each.file, each.line
        )


def _with_properties(declared: Declaration, properties: Iterable[Property], values: Values) -> Declaration:
    said = dict(declared.said)
    for each in properties:
        if each.name in declared.parameters:
            said[each.name] = each
        elif each.name in _IGNORED:
            values.warnings.append(f"{each.name} of {declared.id} means nothing here and is left out")
        else:
            known = choices(each.name, declared.parameters)
            raise RecipeError(f"{declared.model} has no {each.name}, it has {known}", each.file, each.line)
    return replace(declared, said=said)
