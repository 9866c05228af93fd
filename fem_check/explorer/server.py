"""Serves the page to this machine only."""

import asyncio
import logging
import socket
import sys
import webbrowser
from typing import Any

from fem_check.explorer.page import Page
from linear_theory.common.extras import optional

HOST = "127.0.0.1"


def free_port(port: int | None) -> int:
    """The port, or a free one for None. Raises OSError, naming it, if it is in use.

    >>> from fem_check.explorer.server import free_port
    >>> free_port(None) > 0
    True
    """
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((HOST, port or 0))
        except OSError as problem:
            raise OSError(f"port {port}: {problem.strerror or problem}; try another one") from None
        return int(probe.getsockname()[1])


def serve(port: int | None, browser: bool) -> None:
    """Serve the page until Ctrl-C. port: None for a free one; browser: whether to open one.

    Raises OSError if the port is in use, ModuleNotFoundError if the extra is missing.
    """
    panel = optional("panel", "explorer", "sheetcrawl explore")
    port = free_port(port)
    address = f"http://{HOST}:{port}/"
    server = panel.serve(
        {"/": _page}, address=HOST, port=port, show=False, start=False, title="sheetcrawl explore",
        websocket_origin=[f"{HOST}:{port}", f"localhost:{port}"], verbose=False,
        check_unused_sessions_milliseconds=2000, unused_session_lifetime_milliseconds=5000,
    )  # fmt: skip
    _ignore_closed_windows(server.io_loop.asyncio_loop)
    print(f"{address}  (Ctrl-C ends)", flush=True)
    if browser and not webbrowser.open(address):
        print("sheetcrawl: no browser was found; open the address above in one", file=sys.stderr)
    server.io_loop.start()


def _ignore_closed_windows(loop: asyncio.AbstractEventLoop) -> None:
    """A window that is closed while an answer is on its way is no fault: print nothing."""
    closed = optional("tornado.websocket", "explorer", "sheetcrawl explore").WebSocketClosedError

    def handle(loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        if not isinstance(context.get("exception"), closed):
            loop.default_exception_handler(context)

    loop.set_exception_handler(handle)
    logging.getLogger("bokeh.server.views.ws").setLevel(logging.ERROR)


def _page() -> Any:
    """One page per browser window."""
    panel = optional("panel", "explorer", "sheetcrawl explore")
    page = Page()
    panel.state.on_session_destroyed(lambda _: page.close())
    return page.layout()
