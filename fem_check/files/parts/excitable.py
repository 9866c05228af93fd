"""An excitable wave from its tables, and the tables of one."""

from typing import Any

from fem_check.excitable.equation import FitzHughNagumo
from fem_check.excitable.excitation import Excitation
from fem_check.excitable.feedback import StrainFeedback
from fem_check.excitable.methods import Adaptive
from fem_check.excitable.periodic.wave import PeriodicExcitation
from fem_check.excitable.presets import PRESETS
from fem_check.excitable.starts import (
    BumpStart,
    CrossedStart,
    Pacing,
    RationalStart,
    Start,
    UniformStart,
)
from fem_check.files.equations import EquationTable, PacingTable, StartTable
from fem_check.files.system import System
from fem_check.files.tables import WaveTable
from linear_theory.common import validation
from linear_theory.common.validation import shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Wave

STARTS: dict[str, type[Start]] = {
    "rational": RationalStart,
    "uniform": UniformStart,
    "bump": BumpStart,
    "crossed": CrossedStart,
}
"""By their names in a file."""

KEYS = {
    "rational": ("origin", "scale"),
    "uniform": ("c", "w"),
    "bump": ("height", "radius", "x", "y"),
    "crossed": ("c_size", "w_size", "step"),
}
"""Keys of a start."""

NUMBERS = ("threshold", "recovery_decay", "recovery_rate", "diffusion_length")

RTOL = 1e-3
"""Of c, unless given."""

Entries = dict[str, Any]


def excitable_of(table: WaveTable, system: System, sheet: Sheet) -> Wave:
    """The wave on a sheet. Raises ValueError for keys that are missing or do not go together."""
    if table.equation is None:
        raise ValueError(
            "equation: must be given for kind = 'excitable', such as { preset = 'printed' }"
        )
    if table.until is None:
        raise ValueError("until: must be given for kind = 'excitable': the time to solve it for")
    assert table.equation is not None
    equation = _equation(table.equation, system, sheet.length)
    rtol = system.number(table.rtol, RTOL)
    solution = Excitation(equation, sheet, system.number(table.until), rtol)
    if not table.orbit:
        return solution
    if equation.acts_back:
        raise ValueError("orbit: must be left out beside feedback, with which c depends on the motion")
    return solution.periodic()


def _equation(table: EquationTable, system: System, length: float) -> FitzHughNagumo:
    """That of the preset, with what else is said."""
    said = {n: getattr(table, n) for n in NUMBERS if getattr(table, n) is not None}
    if table.diffusion_length is not None:
        said["diffusion_length"] = system.number(table.diffusion_length)
    if table.feedback is not None:
        said["feedback"] = StrainFeedback(table.feedback)
    if table.start is not None:
        said["start"] = _start(table.start, system, length)
    if table.pacing is not None:
        said["pacing"] = _pacing(table.pacing, system, length)
    if table.preset is not None:
        return PRESETS[table.preset].equation.scaled(length).but(**said)
    missing = [name for name in NUMBERS if name not in said]
    if missing:
        raise ValueError(f"equation: must have {', '.join(missing)}, or a preset")
    return FitzHughNagumo(**{"start": RationalStart(scale=length), **said})


def _start(table: StartTable, system: System, length: float) -> Start:
    """With the lengths that are not said as shares of that of the sheet."""
    said = {n: getattr(table, n) for n in table.model_fields_set - {"kind"}}
    wrong = sorted(set(said) - set(KEYS[table.kind]))
    if wrong:
        raise ValueError(f"start.{wrong[0]}: must be left out of a start of kind = {table.kind!r}")
    kind = STARTS[table.kind]
    said |= {n: system.number(said[n]) for n in kind.sizes if n in said}
    if table.kind == "bump":
        said["position"] = said.pop("x", None), said.pop("y", -0.5)
    default = kind().scaled(length)
    return kind(**{**{n: getattr(default, n) for n in kind.sizes}, **said})


def _pacing(table: PacingTable, system: System, length: float) -> Pacing:
    default = Pacing(system.number(table.period), duration=1e-3 * system.number(table.period))
    duration = system.number(table.duration, Pacing.duration)
    reach = system.number(table.reach, default.reach * length)
    return Pacing(default.period, table.strength, duration, reach, table.front)


def entries_of(wave: Excitation | PeriodicExcitation) -> Entries:
    """What stands in [wave] for it, in full. Raises ValueError for what a file cannot say."""
    validation.instance("body", wave.body, Sheet, "a scene file says waves on rectangles only")
    if wave.method != Adaptive():
        raise ValueError(f"method = {shown(wave.method)}: must be Adaptive() in a scene file")
    periodic = isinstance(wave, PeriodicExcitation)
    until = wave.after if isinstance(wave, PeriodicExcitation) else wave.until
    entries: Entries = {"kind": "excitable", "until": until, "rtol": wave.rtol}
    entries |= {"orbit": True} if periodic else {}
    e = wave.equation
    equation: Entries = {name: getattr(e, name) for name in NUMBERS}
    equation |= {} if e.feedback is None else {"feedback": e.feedback.coefficient}
    equation["start"] = _start_entries(e.start)
    if e.pacing is not None:
        equation["pacing"] = {n: v for n, v in e.pacing.to_dict().items() if n != "type"}
    return {**entries, "equation": equation}


def _start_entries(start: Start) -> Entries:
    kind = next((name for name, known in STARTS.items() if type(start) is known), None)
    if kind is None:
        raise ValueError(f"start: a {type(start).__name__} cannot be written to a scene file")
    entries = {n: v for n, v in start.to_dict().items() if n != "type"}
    if isinstance(start, BumpStart):
        x, y = start.position
        del entries["position"]
        entries |= {"y": y} if x is None else {"x": x, "y": y}
    return {"kind": kind, **entries}
