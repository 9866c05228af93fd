"""The JSON Schema of scene files, for editors and for other programs."""

from typing import Any

from pydantic import create_model

from fem_check.files.fields import Table
from fem_check.files.tables import REQUIRED, TABLES

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def schema() -> dict[str, Any]:
    """As plain data, made of the same tables that files are checked by.

    >>> from fem_check.files.schema import schema
    >>> print(schema()["required"], *sorted(schema()["properties"])[:4])
    ['growth'] bending dead_load friction gravity
    """
    entries: dict[str, Any] = {
        name: (kind, ...) if name in REQUIRED else (kind | None, None) for name, kind in TABLES.items()
    }
    scene = create_model("Scene", __base__=Table, __doc__="A scene of sheetcrawl.", **entries)
    return {"$schema": DIALECT, **scene.model_json_schema()}
