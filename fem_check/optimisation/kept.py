"""Answers of an optimisation in a file, from which one that was stopped goes on.

A line of JSON for each, after a first line that says what was asked. The points of a climb follow from
its answers, so that the same call repeats them from the file, in no time, up to where it was stopped. A
line that was cut off by a kill is left out; one whose digits were damaged is refused, by its checksum.
"""

import json
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from fem_check.runs.lock import claimed
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Evaluation, Unusable

Array = NDArray[np.float64]

LOCK = ".lock"
"""Suffix of the file that keeps a second process away."""


SUM = "crc32"
"""Name of the checksum in a line; a line of an earlier version has none."""


class KeptError(SheetcrawlError, ValueError):
    """A file of answers that cannot be gone on with."""


class Kept:
    """Answers by what was asked and at which point; in memory, and in a file if there is one.

    path: of the file; question: what is asked, as plain data. To be used in a `with`. Raises KeptError
    for a file that is of another question, or in use, or no such file.
    """

    def __init__(self, path: Path | None = None, question: Mapping[str, Any] | None = None) -> None:
        self.path, self._question = path, json.loads(json.dumps(question))
        self._known: dict[str, dict[str, Any]] = {}
        self._file: IO[str] | None = None
        self._lock: Any = None
        self.fresh = 0
        self.told: Callable[[], None] = lambda: None

    def __enter__(self) -> "Kept":
        if self.path is None:
            return self
        try:
            self._lock = claimed(self.path.with_name(self.path.name + LOCK), stays=False)
            holder = self._lock.__enter__()
            if holder:
                raise KeptError(f"{self.path}: is being written by {holder}")
            self._begin(self.path)
        except OSError as problem:
            self.__exit__()
            raise KeptError(f"{self.path}: cannot be written ({problem.strerror})") from None
        except KeptError:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._file is not None:
            self._file.close()
        if self._lock is not None:
            lock, self._lock = self._lock, None
            lock.__exit__(None, None, None)

    def _begin(self, path: Path) -> None:
        data = path.read_bytes() if path.exists() else b""
        whole = data[: data.rfind(b"\n") + 1]
        lines = [
            self._parsed(k, line)
            for k, line in enumerate(whole.decode("utf-8", "replace").splitlines())
        ]
        if lines and lines[0] != {"question": self._question}:
            raise KeptError(
                f"{path}: holds answers to another question; give another file, or remove it"
            )
        self._known = {line["key"]: line for line in lines[1:]}
        self._file = open(path, "a", encoding="utf-8")  # noqa: SIM115
        self._file.truncate(len(whole))  # never shorter: a kill at any instant leaves what was kept
        if not whole:
            self._write({"question": self._question})

    def _parsed(self, number: int, line: str) -> dict[str, Any]:
        """A line, the question first; raises KeptError for one that this class did not write."""
        try:
            found = json.loads(line)
        except json.JSONDecodeError:
            found = None
        whole = isinstance(found, dict) and found.pop(SUM, None) in (None, _sum_of(found))
        if not whole or not (_is_answer(found) if number else "question" in found):
            raise KeptError(
                f"{self.path}, line {number + 1}: is no answer of an optimisation; remove the line, or "
                "the file to begin anew"
            )
        return found

    @property
    def count(self) -> int:
        """Of answers, kept and new."""
        return len(self._known)

    def value(self, what: str, point: Array, work: Callable[[], Estimate]) -> Estimate:
        """That of the file, or that of the work, which is then kept."""
        found = self._found(what, point, lambda: dict(zip(("value", "error"), work(), strict=True)))
        return Estimate(found["value"], found["error"])

    def evaluation(self, what: str, point: Array, work: Callable[[], Evaluation]) -> Evaluation:
        """The same of an evaluation."""

        def said() -> dict[str, Any]:
            new = work()
            lists = {"gradient": new.gradient.tolist(), "doubt": new.doubt.tolist()}
            return {"value": new.value, "error": new.error, **lists, "kink": new.kink}

        found = self._found(what, point, said)
        arrays = np.array(found["gradient"]), np.array(found["doubt"])
        return Evaluation(found["value"], found["error"], *arrays, found["kink"])

    def _found(self, what: str, point: Array, work: Callable[[], dict[str, Any]]) -> dict[str, Any]:
        key = f"{what} {' '.join(float(x).hex() for x in point)}"
        if key not in self._known:
            try:
                new = {"key": key, **work()}
            except Unusable as problem:
                new = {"key": key, "unusable": str(problem)}
            self._known[key] = new
            self.fresh += 1
            self._write(new)
        self.told()
        found = self._known[key]
        if "unusable" in found:
            raise Unusable(found["unusable"])
        return found

    def _write(self, line: Mapping[str, Any]) -> None:
        if self._file is not None:
            self._file.write(json.dumps({**line, SUM: _sum_of(line)}) + "\n")
            self._file.flush()


def _sum_of(line: Mapping[str, Any]) -> int:
    """Of what a line says, by which damaged digits are noticed."""
    return zlib.crc32(json.dumps(line).encode())


def _is_answer(line: Mapping[str, Any]) -> bool:
    """Whether it has a key and a value with its error, maybe a gradient, or why there is none."""
    if not isinstance(line.get("key"), str):
        return False
    if "unusable" in line:
        return isinstance(line["unusable"], str)
    lists = [line.get(name, []) for name in ("gradient", "doubt")]
    numbers = [line.get("value"), line.get("error"), *(x for found in lists for x in _entries(found))]
    whole = isinstance(line.get("kink", ""), str) and ("gradient" in line) == ("doubt" in line)
    whole = whole and all(isinstance(x, int | float) for x in numbers)
    size = sum("0x" in word for word in line["key"].split())  # of the point, in hexadecimal digits
    whole = whole and all(len(one) == size for one in lists if "gradient" in line)
    return whole and not line["error"] < 0


def _entries(found: Any) -> Any:
    return found if isinstance(found, list) else [None]
