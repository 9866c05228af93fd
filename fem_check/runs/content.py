"""What result.json must hold: checked once, as it is read, so that no reader meets a surprise."""

from collections.abc import Mapping
from typing import Any

NUMBER = (int, float)

Kinds = type | tuple[type, ...]

CONTENT: dict[str, Kinds] = {
    "block": str,
    "units": (dict, type(None)),
    "answer": dict,
    "answer.mean": NUMBER,
    "answer.error": (*NUMBER, type(None)),
    "answer.numerical_error": (*NUMBER, type(None)),
    "answer.converged": bool,
    "errors": list,
    "cost": list,
    "scene": dict,
    "run": dict,
    "versions": dict,
}
"""Types by the path of a value."""

ROWS: dict[str, dict[str, Kinds]] = {
    "errors": {"part": str, "error": (*NUMBER, str, type(None))},
    "cost": {"part": str, "seconds": NUMBER, "work": str},
}
"""Types in each row of a list."""

WORDS = {
    str: "a text",
    bool: "true or false",
    dict: "an object",
    list: "a list",
    int: "a number",
    float: "a number",
    type(None): "null",
}


def mistake(result: Any) -> str:
    """What is wrong with the content, in words; empty if it is that of a run."""
    if not isinstance(result, dict):
        return f"must be an object, is {_words(type(result))}"
    kinds = {**CONTENT, **dict.fromkeys(("units.length", "units.time"), str)}
    if result.get("units", {}) is None:
        kinds = CONTENT
    return _mistake(result, kinds) or next(filter(None, map(_of_rows(result), ROWS)), "")


def _of_rows(result: Mapping[str, Any]) -> Any:
    def wrong(name: str) -> str:
        for number, row in enumerate(result[name]):
            if not isinstance(row, dict):
                return f"{name}[{number}] must be an object, is {_words(type(row))}"
            if said := _mistake(row, ROWS[name]):
                return f"{name}[{number}].{said}"
        return ""

    return wrong


def _mistake(values: Mapping[str, Any], kinds: Mapping[str, Kinds]) -> str:
    """The first value that is missing or of another type."""
    for path, kind in kinds.items():
        value: Any = values
        for name in path.split("."):
            if name not in value:
                return f"{path} is missing"
            value = value[name]
        # Python counts true as a number; JSON does not.
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            return f"{path} must be {_words(kind)}, is {_words(type(value))}"
    return ""


def _words(kinds: Kinds) -> str:
    names = kinds if isinstance(kinds, tuple) else (kinds,)
    return " or ".join(dict.fromkeys(WORDS[kind] for kind in names))
