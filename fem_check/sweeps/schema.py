"""The JSON Schema of sweep files, for editors and for other programs."""

from typing import Any

from fem_check.files.schema import DIALECT
from fem_check.files.schema import schema as of_scenes
from fem_check.sweeps.points.fields import paths
from fem_check.sweeps.sweep_file import RangeTable, SweepTable


def schema() -> dict[str, Any]:
    """As plain data, made of the tables that files are checked by.

    >>> from fem_check.sweeps.schema import schema
    >>> print(*schema()["required"], *list(schema()["properties"]["over"]["properties"])[:2])
    scene over sheet sheet.length
    """
    scene = of_scenes()
    shared = scene.pop("$defs")
    del scene["$schema"]
    values = {
        "anyOf": [{"type": "array", "minItems": 1}, {"$ref": "#/$defs/RangeTable"}],
        "description": "the values of this field, or a range",
    }
    return {
        "$schema": DIALECT,
        "title": "Sweep",
        "description": "A sweep of sheetcrawl: many scenes that differ in some fields.",
        "type": "object",
        "properties": {
            "scene": {"anyOf": [{"type": "string"}, {"$ref": "#/$defs/Scene"}]},
            "over": _over(values),
            "sweep": {"$ref": "#/$defs/SweepTable"},
        },
        "required": ["scene", "over"],
        "additionalProperties": False,
        "$defs": {
            **shared,
            "Scene": scene,
            "RangeTable": RangeTable.model_json_schema(),
            "SweepTable": SweepTable.model_json_schema(),
        },
    }


def _over(values: dict[str, Any]) -> dict[str, Any]:
    """Paths with dots, quoted, and the tables that TOML makes of them where they are not."""
    over = _table()
    for path in paths():
        *tables, key = path.split(".")
        inner = over
        for name in tables:
            inner = inner["properties"].setdefault(name, _table())
        inner["properties"][key] = values
        over["properties"][path] = values
    return {**over, "minProperties": 1}


def _table() -> dict[str, Any]:
    return {"type": "object", "properties": {}, "additionalProperties": False}
