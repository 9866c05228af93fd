"""A real Chromium, driven by plain HTTP: the W3C WebDriver protocol, without a client library."""

import base64
import contextlib
import json
import shutil
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

FLAGS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
"""Without a screen, as root in a container, and without the browser's own requests."""

PATIENCE = 180
"""Seconds for a command: on a busy machine a browser may need a minute to start."""

FOUND = {name: shutil.which(name) for name in ("chromium", "chromedriver")}
"""Paths of the programs; None where one is missing (Debian: chromium, chromium-driver)."""


class Browser:
    """One window. Sizes in pixels; errors of the driver are raised as RuntimeError."""

    def __init__(self, port: int, profile: str) -> None:
        self._driver, self._session = f"http://127.0.0.1:{port}", ""
        options = {"args": [*FLAGS, f"--user-data-dir={profile}"], "binary": FOUND["chromium"]}
        wanted = {
            "browserName": "chrome",
            "goog:chromeOptions": options,
            "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"},
        }
        found = self._call("", {"capabilities": {"alwaysMatch": wanted}})
        self._session = f"/{found['sessionId']}"

    def _call(self, path: str, body: Any = None) -> Any:
        data = None if body is None else json.dumps(body).encode()
        url = f"{self._driver}/session{self._session}{path}"
        request = urllib.request.Request(url, data, {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as refused:
            raise RuntimeError(json.load(refused)["value"]["message"]) from None

    def size(self, width: int, height: int) -> None:
        """Set the size of the page, as a phone or a desk has it."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        command = {"cmd": "Emulation.setDeviceMetricsOverride", "params": metrics}
        self._call("/goog/cdp/execute", command)

    def open(self, url: str) -> None:
        """Load a page and wait for it."""
        self._call("/url", {"url": url})

    def run(self, script: str, *arguments: Any) -> Any:
        """Run a body of JavaScript; what it returns."""
        return self._call("/execute/sync", {"script": script, "args": list(arguments)})

    def picture(self, path: Path) -> None:
        """Save what is seen as PNG."""
        path.write_bytes(base64.b64decode(self._call("/screenshot")))

    def complaints(self) -> list[str]:
        """Errors and warnings on the console since the last call."""
        return [
            e["message"] for e in self._call("/se/log", {"type": "browser"}) if e["level"] != "INFO"
        ]

    def requests(self) -> list[str]:
        """Addresses asked for since the last call, web sockets included."""
        found = []
        for entry in self._call("/se/log", {"type": "performance"}):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
            if message["method"] == "Network.webSocketCreated":
                found.append(message["params"]["url"])
        return found


@contextlib.contextmanager
def browser() -> Iterator[Browser]:
    """A browser with an empty profile, ended with its driver."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        driver = subprocess.Popen(
            [str(FOUND["chromedriver"]), "--port=0"], stdout=subprocess.PIPE, text=True
        )
        try:
            assert driver.stdout is not None
            said = next(line for line in driver.stdout if "started successfully on port" in line)
            window = Browser(int(said.split()[-1].rstrip(".")), profile)
            try:
                yield window
            finally:
                _quit(window)
        finally:
            driver.terminate()
            driver.wait(10)
            if driver.stdout:
                driver.stdout.close()


def _quit(window: Browser) -> None:
    request = urllib.request.Request(f"{window._driver}/session{window._session}", method="DELETE")
    with contextlib.suppress(OSError), urllib.request.urlopen(request, timeout=20):
        pass


def until(answer: Callable[[], T], seconds: float = 20.0) -> T:
    """The first true answer; AssertionError after the time."""
    end = time.monotonic() + seconds
    while not (found := answer()):
        assert time.monotonic() < end, f"not within {seconds:g} s"
        time.sleep(0.02)
    return found
