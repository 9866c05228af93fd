"""report.html: one file that tells and shows a finished run, without anything from elsewhere."""

import base64
import html
import json
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np
from matplotlib.colors import to_hex

from fem_check.answer.block import LABEL
from fem_check.answer.rounding import measured, plain
from fem_check.answer.units import Units
from fem_check.output.files import replacing
from fem_check.output.panels import GROWTH_MAP
from fem_check.output.tint import tint
from fem_check.runs.animation import data_of
from fem_check.runs.finished import Finished
from fem_check.runs.folder import SCENE, SCENE_DATA

PAGE = files("fem_check.runs") / "page"

MISSING = "not estimated"

INDENT = LABEL + 2
"""Columns of the block before its text."""


def write_report(found: Finished, path: Path) -> Path:
    """The page of a run whose pictures have been drawn; it appears when it is whole."""
    text = report(found)
    with replacing(path) as part:
        part.write_text(text, encoding="utf-8")
    return path


def report(found: Finished) -> str:
    """Its text. Every picture and script is part of it."""
    recording = found.recording
    units = found.units or Units.of_sheet(recording.length, recording.period)
    answer, colours = found.result["answer"], tint(recording.growth, recording.wave)
    parts = {
        "title": "A crawling sheet",
        "mean": repr(answer["mean"]),
        "shown": shown_speed(found),
        "met": "met" if found.converged else "missed",
        "met_words": _met(answer),
        "block": _rows(found.block),
        "errors": _errors(found, units),
        "cost": _cost(found),
        "scene": _scene(found.folder),
        "versions": ", ".join(f"{name} {number}" for name, number in found.result["versions"].items()),
        "coloured": "its growth" if colours.grows else "the wave",
        "tint": "<i>&alpha;</i>c" if colours.grows else "c",
        "most": f"{plain(colours.most)} {colours.unit}".rstrip(),
        "ground": "; the dark line is the ground below its middle"
        if np.ptp(recording.floor[1])
        else "",
    }
    escaped = {name: html.escape(text) for name, text in parts.items() if name not in TABLES}
    inlined = {
        "style": Template(_file("style.css")).substitute(gradient=_gradient()),
        "script": _file("sheet.js"),
        "data": json.dumps(data_of(recording, units)).replace("<", "\\u003c"),
        "motion": _picture(found.folder / "motion.png"),
        "kymographs": _picture(found.folder / "kymographs.png"),
        **{name: parts[name] for name in TABLES},
    }
    return Template(_file("report.html")).substitute(escaped, **inlined)


def _met(answer: dict[str, Any]) -> str:
    """Whether the tolerance was met, in words."""
    if answer.get("caution"):
        return "with a caution"
    if answer.get("tolerance", True) is None:
        return "no tolerance asked for"
    return "tolerance met" if answer["converged"] else "tolerance not met"


TABLES = ("block", "errors", "cost", "tint")
"""Parts that are HTML already."""


def shown_speed(found: Finished) -> str:
    """The speed with its error, as the page says it at its top."""
    recording, answer = found.recording, found.result["answer"]
    units = found.units or Units.of_sheet(recording.length, recording.period)
    error = answer["error"] if answer["error"] is not None else answer["numerical_error"]
    value, wrong = units.of_speed(answer["mean"]), units.of_speed(error or 0.0)
    doubt = " with unknown error" if error is None else ""
    return f"{measured(value, wrong).with_unit(units.speed)}{doubt}"


def _rows(block: str) -> str:
    """The block as a list of labels and texts, which a narrow screen breaks as it must."""
    rows: list[list[str]] = []
    for line in block.splitlines():
        label, text = line[:INDENT].strip(), line[INDENT:].strip()
        if label or not rows:
            rows.append([label, text])
        else:
            rows[-1][1] += f" {text}"
    return "".join(f"<dt>{html.escape(label)}</dt><dd>{html.escape(text)}</dd>" for label, text in rows)


def _errors(found: Finished, units: Units) -> str:
    """The error budget as a table, in the unit of the speed and in per cent of it."""
    mean = found.result["answer"]["mean"]
    rows = []
    for row in found.result["errors"]:
        error = row["error"]
        if not isinstance(error, int | float):
            rows.append((row["part"], error or MISSING, ""))
            continue
        share = f"{plain(100 * error / abs(mean), 2)} %" if mean else ""
        rows.append((row["part"], f"{plain(units.of_speed(error), 2)} {units.speed}", share))
    return _table(("part", "error", "of the speed"), rows)


def _cost(found: Finished) -> str:
    rows = [(one["part"], f"{one['seconds']:.2f} s", one["work"]) for one in found.result["cost"]]
    return _table(("level", "time", "work, or why not"), rows)


def _table(heads: tuple[str, ...], rows: list[tuple[Any, ...]]) -> str:
    top = "".join(f"<th>{html.escape(head)}</th>" for head in heads)
    body = "".join(
        "<tr>"
        + "".join(
            f'<td class="number">{html.escape(str(cell))}</td>'
            if place == 1
            else f"<td>{html.escape(str(cell))}</td>"
            for place, cell in enumerate(row)
        )
        + "</tr>"
        for row in rows
    )
    return f"<table><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table>"


def _scene(folder: Path) -> str:
    path = next((folder / name for name in (SCENE, SCENE_DATA) if (folder / name).exists()), None)
    return "" if path is None else path.read_text(encoding="utf-8")


def _picture(path: Path) -> str:
    return base64.b64encode(path.read_bytes()).decode("ascii")


def _file(name: str) -> str:
    return (PAGE / name).read_text(encoding="utf-8")


def _gradient() -> str:
    """The colours of growth, as in the animation."""
    colours = ", ".join(to_hex(GROWTH_MAP(k / 8)) for k in range(9))
    return f"background: linear-gradient(to right, {colours});"
