"""The commands as the parser sees them; the code that does the work is imported when needed."""

from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from fem_check.command.options import Options
from fem_check.command.screens import (
    CHECK_HELP,
    EXAMPLES_HELP,
    EXPLORE_HELP,
    MOVIE_HELP,
    NEW_HELP,
    OPTIMISE_HELP,
    PARAVIEW_HELP,
    PLOT_HELP,
    RUN_HELP,
    SCHEMA_HELP,
    SHOW_HELP,
    SPEED_HELP,
    SWEEP_HELP,
    examples,
    welcome,
)

app = App(
    name="sheetcrawl",
    help="How fast a thin sheet crawls when a wave of growth runs through it.",
    version=lambda: f"sheetcrawl {version('sheetcrawl')}",
    version_flags=["--version"],
    help_format="plaintext",
    default_parameter=Parameter(negative=()),
    result_action="return_value",
    suppress_keyboard_interrupt=False,  # `program` prints a line
)
app.register_install_completion_command(add_to_startup=False)


@app.default
def _welcome() -> None:
    print(welcome())


SceneArgument = Annotated[
    Path | None,
    Parameter(
        help="A scene file, NAME.toml, instead of the options for sheet, wave, growth, friction."
    ),
]


@app.command(name="speed", help=SPEED_HELP)
def _speed(
    scene: SceneArgument = None, /, *, options: Annotated[Options | None, Parameter(name="*")] = None
) -> int:
    from fem_check.command.actions.speed import speed

    return speed(options or Options(), scene)


FolderArgument = Annotated[Path, Parameter(help="The folder of a finished run.")]


@app.command(name="run", help=RUN_HELP)
def _run(
    scene: Annotated[Path, Parameter(help="A scene file, NAME.toml.")],
    /,
    *,
    out: Annotated[Path | None, Parameter(help="The folder; NAME here unless given.")] = None,
    resume: Annotated[bool, Parameter(help="Go on from an interrupted run in the folder.")] = False,
) -> int:
    from fem_check.command.actions.runs import run

    return run(scene, out, resume)


@app.command(name="show", help=SHOW_HELP)
def _show(folder: FolderArgument, /) -> int:
    from fem_check.command.actions.runs import show

    return show(folder)


@app.command(name="movie", help=MOVIE_HELP)
def _movie(
    folder: FolderArgument,
    /,
    *,
    file: Annotated[Path | None, Parameter(help="motion.gif in the folder unless given.")] = None,
    periods: Annotated[int | None, Parameter(help="All, or 2 of a motion that repeats.")] = None,
    frames: Annotated[int, Parameter(help="To a period of the wave.")] = 24,
    width: Annotated[int, Parameter(help="In pixels.")] = 640,
    exaggerate: Annotated[float, Parameter(help="Factor on the displacement in the sheet.")] = 1.0,
) -> int:
    from fem_check.command.actions.runs import movie

    return movie(folder, file, periods, frames, width, exaggerate)


@app.command(name="plot", help=PLOT_HELP)
def _plot(
    folder: FolderArgument,
    /,
    *,
    file: Annotated[Path | None, Parameter(help=".png, .pdf or .svg; else all, in the folder.")] = None,
    what: Annotated[
        str, Parameter(help="In that file: motion, kymographs, or one panel, such as speed or path.")
    ] = "motion",
) -> int:
    from fem_check.command.actions.runs import plot

    return plot(folder, file, what)


@app.command(name="paraview", help=PARAVIEW_HELP)
def _paraview(
    folder: FolderArgument,
    /,
    *,
    file: Annotated[Path | None, Parameter(help="motion.xdmf in the folder unless given.")] = None,
) -> int:
    from fem_check.command.actions.runs import paraview

    return paraview(folder, file)


@app.command(name="new", help=NEW_HELP)
def _new(
    name: Annotated[str | None, Parameter(help="Of a scene of the gallery, see --list.")] = None,
    file: Annotated[Path | None, Parameter(help="To write to; NAME.toml here unless given.")] = None,
    /,
    *,
    show: Annotated[bool, Parameter(name="--list", help="List the names, write nothing.")] = False,
) -> int:
    from fem_check.command.actions.scene_files import new

    return new(None if show else name, file)


@app.command(name="check", help=CHECK_HELP)
def _check(
    file: Annotated[Path, Parameter(help="A scene file, or one of a sweep or of an optimisation.")], /
) -> int:
    from fem_check.command.actions.checking import check

    return check(file)


@app.command(name="schema", help=SCHEMA_HELP)
def _schema(
    *, sweep: Annotated[bool, Parameter(help="Of sweep files instead of scene files.")] = False
) -> int:
    from fem_check.command.actions.scene_files import schema

    return schema(sweep)


@app.command(name="sweep", help=SWEEP_HELP)
def _sweep(
    file: Annotated[
        Path, Parameter(help="A sweep file, NAME.toml; or a file with records, to be exported.")
    ],
    /,
    *,
    out: Annotated[
        Path | None, Parameter(help="For the records; NAME.sqlite here unless given.")
    ] = None,
    workers: Annotated[int | None, Parameter(help="Processes; as many as cores unless given.")] = None,
    scheduler: Annotated[
        str | None, Parameter(help="Address of a Dask scheduler that runs elsewhere, tcp://...")
    ] = None,
    dry_run: Annotated[bool, Parameter(help="Say what it would cost, and do nothing.")] = False,
    export: Annotated[
        list[Path] | None,
        Parameter(help="Write .nc, .csv or .parquet: one file or several.", consume_multiple=True),
    ] = None,
    retry: Annotated[bool, Parameter(help="Try scenes again that have failed.")] = False,
) -> int:
    from fem_check.command.actions.sweep import sweep

    return sweep(file, out, workers, scheduler, dry_run, export or [], retry)


@app.command(name="optimise", help=OPTIMISE_HELP)
def _optimise(
    file: Annotated[Path, Parameter(help="An optimisation file, NAME.toml.")],
    /,
    *,
    kept: Annotated[
        Path | None, Parameter(help="For the answers; NAME.answers.jsonl here unless given.")
    ] = None,
    out: Annotated[Path | None, Parameter(help="Write the best scene, .toml.")] = None,
    movie: Annotated[
        Path | None, Parameter(help="Film the given scene and the best one, .gif or .mp4.")
    ] = None,
) -> int:
    from fem_check.command.actions.optimise import optimise

    return optimise(file, kept, out, movie)


@app.command(name="explore", help=EXPLORE_HELP)
def _explore(
    *,
    port: Annotated[
        int | None, Parameter(help="Port of the address on this computer; a free one by default.")
    ] = None,
    no_browser: Annotated[bool, Parameter(help="Print the address only.")] = False,
) -> int:
    from fem_check.command.actions.explore import explore

    return explore(port, not no_browser)


@app.command(name="examples", help=EXAMPLES_HELP)
def _examples() -> None:
    print(examples())
