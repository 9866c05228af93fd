"""Scenes are written as scene files, in plain numbers in units of the sheet, and are the same again."""

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from fem_check.choice.settings import RunSettings
from fem_check.excitable.excitation import Excitation
from fem_check.excitable.periodic.wave import PeriodicExcitation
from fem_check.files.mistakes import SceneFileError
from fem_check.files.parts import excitable, friction
from fem_check.files.reading import parsed
from fem_check.files.toml import text_of
from fem_check.output.files import replacing
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.effects.formula import text_of as formula_of
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.height_map import HeightMap
from fem_check.shell.effects.height_sources import is_expression
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.effects.terrain import Terrain
from linear_theory.common import validation
from linear_theory.common.validation import shown
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.identity import content_key
from linear_theory.scene.effects import contact_of
from linear_theory.scene.scene import PARTS, Scene
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.travelling import SineWave, TravellingWave

HEAD = "A scene of sheetcrawl, in plain numbers: lengths, times and stresses in units of the sheet."

INSTEAD = "keep it by to_dict(), which is plain data for a scene.json"

UNNAMED = Path("scene.toml")
"""Where the text would be."""

PLACE = rf"^{UNNAMED}(:\d+)?: "

Entries = dict[str, Any]


def write(scene: Scene, path: str | Path, run: RunSettings | None = None, head: str = HEAD) -> Path:
    """Write a scene to a file from which `read` makes the same, and return its path.

    run: how it is to be answered; head: comment at the top. The file appears when it is whole.
    Raises ValueError for a scene that no text holds (waves and ground that are functions, laws and
    effects of one's own) and OSError where the file cannot be written.
    """
    text, target = toml_of(scene, run, head), Path(path)
    with replacing(target) as part:
        part.write_text(text, encoding="utf-8")
    return target


def toml_of(scene: Scene, run: RunSettings | None = None, head: str = HEAD) -> str:
    """The text of that file, found to say the same scene."""
    text = text_of(tables_of(scene, run), head)
    try:
        again = parsed(text, UNNAMED).scene
    except SceneFileError as problem:  # of a file that there is not
        words = "; ".join(re.sub(PLACE, "", mistake) for mistake in problem.mistakes)
        raise ValueError(f"scene: a scene file cannot say this ({words}); {INSTEAD}") from None
    for part in PARTS:
        mine, theirs = (content_key(getattr(one, part), part) for one in (scene, again))
        if mine != theirs:
            raise ValueError(f"{part}: a scene file cannot say exactly this; {INSTEAD}")
    return text


def tables_of(scene: Scene, run: RunSettings | None = None) -> dict[str, Entries]:
    """The tables of a scene, without what is the default."""
    scene = validation.instance("scene", scene, Scene)
    tables = {"sheet": _sheet(scene), "wave": _wave(scene.wave), "growth": _growth(scene)}
    if scene.mesh is not None:
        vertices, elements = (part.T.tolist() for part in (scene.mesh.p, scene.mesh.t))
        tables["outline"] = {"vertices": vertices, "elements": elements}
    contact = _contact(scene)
    if contact:
        tables["friction"] = contact
    for i, effect in enumerate(scene.effects[1:], start=1):
        name, entries = _effect(effect, i)
        tables[name] = _without_defaults(entries)
    settings = {**_run(run or RunSettings()), **_resolution(scene)}
    return {**tables, "run": settings} if settings else tables


def _sheet(scene: Scene) -> Entries:
    """With Young's modulus where the scene names its stretching."""
    entries = {n: v for n, v in scene.sheet.to_dict().items() if n != "type"}
    if scene.effects:
        first = scene.effects[0]
        if type(first) is not Membrane:
            raise ValueError(
                f"effects[0] = {shown(first)}: must be Membrane to be written to a scene file"
            )
        entries["young"] = first.material.young
    return entries


def _wave(wave: Any) -> Entries:
    if type(wave) is SineWave:
        return {"period": wave.period, "count": wave.count}
    if type(wave) is SampledWave:
        return _measured(wave)
    if isinstance(wave, Excitation | PeriodicExcitation):
        return excitable.entries_of(wave)
    if type(wave) is not TravellingWave:
        kind = type(wave).__name__
        raise ValueError(f"wave: a {kind} cannot be written to a scene file, which holds no functions")
    harmonics = {"cosine": wave.cosine.tolist(), "sine": wave.sine.tolist(), "mean": wave.mean}
    return {"kind": "harmonics", "period": wave.period, "count": wave.count, **harmonics}


def _measured(wave: SampledWave) -> Entries:
    """With its samples, so that no other file is needed."""
    data = wave.to_dict()
    names = ("period", "harmonics", "degree")
    asked = {n: v for n, v in zip(names, data["asked"], strict=True) if v is not None}
    return {**asked, "samples": {n: data[n] for n in ("x", "y", "t", "c") if n in data}}


def _growth(scene: Scene) -> Entries:
    growth = scene.growth
    if GROWTH_LAWS.get(growth.law.name) != growth.law:
        raise ValueError(
            f"law = {shown(growth.law)}: must be one of {', '.join(GROWTH_LAWS)} in a scene file"
        )
    entries = {"law": growth.law.name, "area": str(growth.energy_area)}
    coupling = {"curvature_coupling": growth.curvature_coupling, "curvature": str(growth.curvature)}
    return {"alpha": growth.alpha, **entries, **_without_defaults(coupling)}


def _contact(scene: Scene) -> Entries:
    """Load and friction where no effect says them."""
    own, contact = contact_of(scene.effects, scene.components, None), scene.contact
    entries: Entries = {}
    if contact.friction != own.friction:
        entries |= _without_defaults(friction.entries_of(contact.friction))
    if contact.load != own.load:
        entries["load"] = str(contact.load)
    if repr(contact.slope) != repr(own.slope):
        entries["slope"] = contact.slope
    return entries


def _effect(effect: Any, number: int) -> tuple[str, Entries]:
    """The name of its table, and what stands there."""
    name, entries_of = TABLES_OF.get(type(effect), ("", dict))
    if not name:
        kind = type(effect).__name__
        raise ValueError(f"effects[{number}]: a {kind} has no table in a scene file; keep it in Python")
    return name, entries_of(effect)


def _ground(ground: Ground) -> Entries:
    entries = {"stiffness": ground.stiffness, "damping": ground.damping, "load": str(ground.load)}
    terrain = {} if ground.height is None else {"terrain": _terrain(ground.height)}
    return {**entries, "form": ground.form, **terrain}


def _terrain(terrain: Terrain) -> Entries:
    height = terrain.height
    if terrain.name is None and isinstance(height, HeightMap):
        sizes = {"width": height.width, "length": height.length, "smoothing": height.smoothing}
        return {"heights": height.heights.tolist(), **sizes}
    if not is_expression(height):
        raise ValueError(
            f"height = {shown(height)}: a scene file holds no functions; give an expression"
        )
    return {"expression": formula_of(height)}


TABLES_OF: dict[type, tuple[str, Callable[[Any], Entries]]] = {
    Bending: ("bending", lambda effect: {}),
    Gravity: (
        "gravity",
        lambda effect: {"weight": effect.weight, "load": str(effect.load), "incline": effect.incline},
    ),
    Ground: ("ground", _ground),
    Friction: (
        "friction",
        lambda effect: friction.entries_of_effect(effect.coefficient, effect.law),
    ),
    Inertia: ("inertia", lambda effect: {"density": effect.density}),
    SelfContact: (
        "self_contact",
        lambda effect: {"gap": effect.gap, "stiffness": effect.stiffness},
    ),
    DeadLoad: ("dead_load", lambda effect: {"force": list(effect.force)}),
}
"""The table of an effect, and its entries."""

DEFAULTS = {
    "incline": 0.0,
    "heading": 0.0,
    "fixed_to": "body",
    "outside": 1.0,
    "damping": 0.0,
    "form": "clipped",
    "curvature_coupling": 0.0,
    "curvature": "grown",
}
"""Entries that are left out where they say this."""


def _without_defaults(entries: Entries) -> Entries:
    """Compared as text, in which -0.0 is not 0.0, as it is not in the key of a scene."""
    return {n: v for n, v in entries.items() if n not in DEFAULTS or repr(v) != repr(DEFAULTS[n])}


def _run(run: RunSettings) -> Entries:
    default = RunSettings()
    values: Mapping[str, Any] = {n: getattr(run, n) for n in ("level", "rtol", "periods", "steps")}
    return {n: v for n, v in values.items() if v is not None and v != getattr(default, n)}


def _resolution(scene: Scene) -> Entries:
    """Cells and element, where they are given."""
    if scene.elements is None:
        return {}
    said = scene.elements.contents()
    entries: Entries = {} if said["cells"] is None else {"cells": list(said["cells"])}
    return entries if said["element"] is None else {**entries, "element": said["element"]}
