"""Types of the entries of a scene file: how they are checked, one by one, and told to editors."""

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, PlainValidator, WithJsonSchema

from fem_check.files.quantities import KINDS, Quantity, length_unit, read
from linear_theory.common import validation


class Table(BaseModel):
    """A table of a scene file: it knows its keys, takes no other, and converts nothing silently."""

    model_config = ConfigDict(
        defer_build=True,
        extra="forbid",
        strict=True,
        frozen=True,
        use_attribute_docstrings=True,
        allow_inf_nan=False,
    )


def keys_at(kind: type[Table], place: Iterable[str | int]) -> tuple[str, ...]:
    """Keys of a table, or of the one that stands at a place in it."""
    for name in place:
        if isinstance(name, str):
            kind = next(tables_in(kind.model_fields[name].annotation), kind)  # lists have no keys
    return tuple(kind.model_fields)


def tables_in(annotation: Any) -> Iterator[type[Table]]:
    """Tables that a key of that type may hold."""
    if isinstance(annotation, type) and issubclass(annotation, Table):
        yield annotation
    for part in get_args(annotation):
        yield from tables_in(part)


Level = Literal["auto", "predict", "cycle", "stepped", "strip", "first order", "second order"]
"""By which a scene is answered: `choice.ways.ANSWERS`."""

SMALLEST = 1e-100
"""Length or time of a scene, and the largest over 1: squares of others are no numbers any more."""


def _quantity(kind: str, positive: bool = False) -> Any:
    """Annotations of a quantity of that kind, > 0 if it must be."""

    def checked(value: object) -> Quantity:
        found = read(value, kind)
        if not math.isfinite(found.number):
            raise ValueError("must be finite")
        if positive and found.number <= 0:
            raise ValueError("must be > 0")
        if kind in ("length", "time") and positive and not SMALLEST <= found.number <= 1 / SMALLEST:
            raise ValueError(f"must be in [{SMALLEST:g}, {1 / SMALLEST:g}]")
        return found

    return PlainValidator(checked), WithJsonSchema(_schema(kind, positive))


def _schema(kind: str, positive: bool) -> dict[str, Any]:
    """What an editor is told of a quantity."""
    number: dict[str, Any] = {"type": "number"}
    if positive:
        number["exclusiveMinimum"] = 0
    text = {"type": "string", "pattern": r"^\s*[+-]?(\d|\.\d)", "examples": [KINDS[kind].example]}
    article = "an" if kind[0] in "aeiou" else "a"
    return {"description": f"{article} {kind}, with its unit or plain", "anyOf": [number, text]}


def _that(check: Callable[[Any], Any]) -> BeforeValidator:
    """A check of the library, whose message names the argument as the file does the key."""

    def checked(value: Any) -> Any:
        try:
            return check(value)
        except ValueError as problem:
            raise ValueError(str(problem).partition(": ")[2] or str(problem)) from None

    return BeforeValidator(checked)


def _unit_name(value: object) -> str:
    if not isinstance(value, str):
        raise ValueError("must be a unit of length such as 'mm'")
    length_unit(value)
    return value


Length = Annotated[Quantity, *_quantity("length")]
Size = Annotated[Quantity, *_quantity("length", positive=True)]
Time = Annotated[Quantity, *_quantity("time", positive=True)]
Speed = Annotated[Quantity, *_quantity("speed", positive=True)]
Share = Annotated[Quantity, *_quantity("share")]
PositiveShare = Annotated[Quantity, *_quantity("share", positive=True)]
Angle = Annotated[Quantity, *_quantity("angle")]
Curvature = Annotated[Quantity, *_quantity("curvature")]
Pressure = Annotated[Quantity, *_quantity("pressure")]
PositivePressure = Annotated[Quantity, *_quantity("pressure", positive=True)]
Density = Annotated[Quantity, *_quantity("density", positive=True)]
Stiffness = Annotated[Quantity, *_quantity("foundation stiffness", positive=True)]
Damping = Annotated[Quantity, *_quantity("contact damping")]

UnitName = Annotated[str, BeforeValidator(_unit_name)]
# What the library checks, said again for editors: behind such a check pydantic has no words of its own.
Poisson = Annotated[
    float,
    _that(validation.poisson),
    Field(json_schema_extra={"exclusiveMinimum": -1, "maximum": 0.5}),
]
Count = Annotated[int, _that(validation.wave_count), Field(json_schema_extra={"not": {"const": 0}})]
Positive = Annotated[float, Field(gt=0)]
Natural = Annotated[int, Field(ge=1)]
Corner = Annotated[list[float], Field(min_length=2, max_length=2)]
Corners = Annotated[list[Corner], Field(min_length=3)]
