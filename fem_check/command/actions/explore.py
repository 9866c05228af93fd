"""`sheetcrawl explore`: the page with sliders."""

import sys

from fem_check.command.status import MET, MISSED


def explore(port: int | None, browser: bool) -> int:
    """Serve the page until Ctrl-C, return the exit status. Raises ValueError for a bad port."""
    if port is not None and not 1 <= port <= 65535:
        raise ValueError(f"--port {port}: must be from 1 to 65535")
    from fem_check.explorer.server import serve  # here: it loads the levels

    try:
        serve(port, browser)
    except (ModuleNotFoundError, OSError) as problem:
        print(f"sheetcrawl: {problem}", file=sys.stderr)
        return MISSED
    except KeyboardInterrupt:  # the way to end it
        pass
    return MET
