"""From the tables of a file to its scene and its run, part by part, so that all mistakes are found."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.choice.settings import RunSettings as RunSettings  # offered here, too
from fem_check.files.fields import Table
from fem_check.files.mistakes import Mistakes
from fem_check.files.parts.effects import effects_of, with_contact
from fem_check.files.parts.made import Made
from fem_check.files.parts.outlines import mesh_of, sheet_of
from fem_check.files.parts.waves import growth_of, wave_of
from fem_check.files.system import System, system_of
from fem_check.files.tables import RunTable
from fem_check.mesh.elements import from_data
from fem_check.shell.model import ShellModel
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet


@dataclass(frozen=True)
class SceneFile(Shown):
    """What a scene file says. units: of its numbers, None for plain ones. path: of the file."""

    scene: Scene
    run: RunSettings
    units: Units | None
    path: Path


def built(
    tables: Mapping[str, Table], path: Path, mistakes: Mistakes, made: Made | None = None
) -> SceneFile | None:
    """The scene of tables that are right, each for itself; None where mistakes were found.

    made: parts of earlier scenes, which are used again where their tables are the same objects.
    """
    made = Made() if made is None else made
    system = system_of(tables, mistakes)
    if system is None:
        return None
    run = _run(tables["run"], system, mistakes) if "run" in tables else None
    scene = _scene(tables, system, path.parent, mistakes, made)
    if mistakes or scene is None or run is None:
        return None
    return SceneFile(scene, run, system.units, path)


def wave_made_of(
    tables: Mapping[str, Any], system: System | None, sheet: Sheet | None
) -> tuple[Any, ...]:
    """What a wave follows from: its table, units, the sheet if it is solved on it, and the outline."""
    table = tables["wave"]
    body = sheet if table.equation is not None else None
    return table, system, body, tables.get("outline") is not None


def _scene(
    tables: Mapping[str, Any], system: System, folder: Path, mistakes: Mistakes, made: Made
) -> Scene | None:
    """As far as it can be made; None where a part is missing that others need."""
    sheet = wave = growth = None
    if "sheet" in tables:
        with mistakes.under("sheet"):
            sheet = sheet_of(tables["sheet"], tables.get("outline"), system)
    if "wave" in tables and (sheet is not None or tables["wave"].equation is None):
        with mistakes.under("wave"):
            of = wave_made_of(tables, system, sheet)
            table, _, _, cut = of
            wave = made.part("wave", of, lambda: wave_of(table, system, folder, sheet, cut))
    if "growth" in tables and sheet is not None and wave is not None:
        with mistakes.under("growth"):
            growth = growth_of(tables["growth"], system, sheet, wave)
    if sheet is None:
        return None
    effects = effects_of(tables, system, sheet, folder, mistakes, made)
    if mistakes or wave is None or growth is None:
        return None
    scene = None
    with mistakes.under():  # parts that contradict each other, which the message names
        scene = Scene(sheet, wave, growth=growth, effects=effects)
    if scene is not None:
        with mistakes.under("friction"):
            scene = with_contact(scene, tables.get("friction"), system)
        scene = _with_elements(scene, tables, system, folder, mistakes, made)
    if scene is not None and not mistakes and "self_contact" in tables:
        with mistakes.under("self_contact"):
            ShellModel(scene).check_elements()
    return scene


def _with_elements(
    scene: Scene,
    tables: Mapping[str, Any],
    system: System,
    folder: Path,
    mistakes: Mistakes,
    made: Made,
) -> Scene:
    """With the mesh of its outline, and with the elements that [run] asks for."""
    run, outline = tables.get("run"), tables.get("outline")
    if outline is not None:
        with mistakes.under("outline"):
            sheet, plane = scene.sheet, scene.planar
            of = (outline, system, sheet, scene.wave, plane)
            mesh = made.part(
                "mesh", of, lambda: mesh_of(outline, system, sheet, scene.drive, plane, folder)
            )
            scene = scene.but(mesh=mesh)
    if run is not None:
        with mistakes.under("run"):
            said = {"cells": run.cells, "element": run.element}
            if any(said.values()):
                scene = scene.but(**from_data(said))
    return scene


def _run(table: Any, system: System, mistakes: Mistakes) -> RunSettings | None:
    """Settings of the answer, checked as the levels check them."""
    assert isinstance(table, RunTable)
    with mistakes.under("run"):
        if table.steps is not None and table.rtol is not None:
            raise ValueError(f"steps = {table.steps}: must be left out where rtol is given")
        rtol = (
            None if table.steps is not None else validation.tolerance(system.number(table.rtol, 1e-2))
        )
        return RunSettings(table.level, rtol, table.periods, table.steps)
    return None
