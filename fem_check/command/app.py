"""The commands as the parser sees them; the code that does the work is imported when needed."""

from importlib.metadata import version
from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from fem_check.command.options import Options
from fem_check.command.screens import (
    CHECK_HELP,
    EXAMPLES_HELP,
    NEW_HELP,
    SCHEMA_HELP,
    SPEED_HELP,
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
    from fem_check.command.speed import speed

    return speed(options or Options(), scene)


@app.command(name="new", help=NEW_HELP)
def _new(
    name: Annotated[str | None, Parameter(help="Of a scene of the gallery, see --list.")] = None,
    file: Annotated[Path | None, Parameter(help="To write to; NAME.toml here unless given.")] = None,
    /,
    *,
    show: Annotated[bool, Parameter(name="--list", help="List the names, write nothing.")] = False,
) -> int:
    from fem_check.command.scene_files import new

    return new(None if show else name, file)


@app.command(name="check", help=CHECK_HELP)
def _check(scene: Annotated[Path, Parameter(help="A scene file.")], /) -> int:
    from fem_check.command.scene_files import check

    return check(scene)


@app.command(name="schema", help=SCHEMA_HELP)
def _schema() -> int:
    from fem_check.command.scene_files import schema

    return schema()


@app.command(name="examples", help=EXAMPLES_HELP)
def _examples() -> None:
    print(examples())
