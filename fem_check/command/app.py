"""The commands as the parser sees them; the code that does the work is imported when needed."""

from importlib.metadata import version
from typing import Annotated

from cyclopts import App, Parameter

from fem_check.command.options import Options
from fem_check.command.screens import EXAMPLES_HELP, EXPLORE_HELP, SPEED_HELP, examples, welcome

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


@app.command(name="speed", help=SPEED_HELP)
def _speed(options: Annotated[Options | None, Parameter(name="*")] = None) -> int:
    from fem_check.command.speed import speed

    return speed(options or Options())


@app.command(name="explore", help=EXPLORE_HELP)
def _explore(
    *,
    port: Annotated[
        int | None, Parameter(help="Port of the address on this computer; a free one by default.")
    ] = None,
    no_browser: Annotated[bool, Parameter(help="Print the address only.")] = False,
) -> int:
    from fem_check.command.explore import explore

    return explore(port, not no_browser)


@app.command(name="examples", help=EXAMPLES_HELP)
def _examples() -> None:
    print(examples())
