"""Debian's Chromium without a window, spoken to over a pipe in the DevTools protocol."""

import base64
import io
import json
import os
import select
import subprocess
import tempfile
import time
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from PIL import Image

PROGRAM = Path("/usr/bin/chromium")

FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--hide-scrollbars", "--remote-debugging-pipe"),
)

PATIENCE = 60.0
"""Seconds for an answer, also on a busy machine."""

COMPLAINTS = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")


class Page:
    """One page of a browser that it starts and ends. Messages are JSON, ended by a zero byte."""

    def __init__(self) -> None:
        self.events: list[dict[str, Any]] = []
        self._count, self._rest = 0, b""

    def __enter__(self) -> "Page":
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        read_own, self._write = os.pipe()
        self._read, write_own = os.pipe()
        # The browser reads from descriptor 3 and writes to 4; the shell puts them there.
        start = f'exec "$0" "$@" 3<&{read_own} 4>&{write_own}'
        self._program = subprocess.Popen(
            ["bash", "-c", start, str(PROGRAM), *FLAGS, f"--user-data-dir={self._profile.name}"],
            pass_fds=(read_own, write_own),
            stderr=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
        )
        os.close(read_own)
        os.close(write_own)
        self._session: str | None = None
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.close(self._write)  # at which the browser ends
        try:
            self._program.wait(10)
        except subprocess.TimeoutExpired:
            self._program.kill()
            self._program.wait()
        os.close(self._read)
        self._profile.cleanup()

    def open(self, path: Path, width: int = 1280, height: int = 900) -> None:
        """Show a file in a window of that size, in pixels, and wait until it is loaded."""
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
        self.send("Emulation.setDeviceMetricsOverride", **size)
        self.events.clear()
        self.send("Page.navigate", url=path.as_uri())
        self._until(lambda: any(e.get("method") == "Page.loadEventFired" for e in self.events))

    def evaluate(self, expression: str) -> Any:
        """The value of JavaScript, also of a promise."""
        found = self.send(
            "Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True
        )
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def picture(self, whole: bool = False) -> np.ndarray:
        """What is seen, or all of the page, (height, width, 3)."""
        found = self.send("Page.captureScreenshot", format="png", captureBeyondViewport=whole)
        data = base64.b64decode(found["data"])
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGB")).astype(int)

    @property
    def complaints(self) -> list[dict[str, Any]]:
        """Errors and all other lines of the console."""
        return [e for e in self.events if e.get("method") in COMPLAINTS]

    @property
    def requests(self) -> list[str]:
        """Addresses that the page has asked for."""
        asked = [e for e in self.events if e.get("method") == "Network.requestWillBeSent"]
        return [e["params"]["request"]["url"] for e in asked]

    def send(self, method: str, **params: Any) -> Any:
        """Give a command and wait for its result."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": params}
        if self._session is not None:
            message["sessionId"] = self._session
        os.write(self._write, json.dumps(message).encode() + b"\0")
        answers: list[dict[str, Any]] = []

        def answered() -> bool:
            answers.extend(e for e in self.events if e.get("id") == self._count)
            return bool(answers)

        self._until(answered)
        assert "error" not in answers[0], answers[0]
        return answers[0]["result"]

    def _until(self, done: Any) -> None:
        """Listen until something has happened."""
        end = time.monotonic() + PATIENCE
        while not done():
            ready, _, _ = select.select([self._read], [], [], max(0.0, end - time.monotonic()))
            data = os.read(self._read, 2**16) if ready else b""
            if not data:
                raise TimeoutError(f"{PROGRAM} does not answer")
            *whole, self._rest = (self._rest + data).split(b"\0")
            self.events += [json.loads(message) for message in whole]
