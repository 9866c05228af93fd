"""A sweep in a process to be killed: python -m tests.sweeps.sweep_child FILE WORKERS|ADDRESS SCENES."""

import sys
from pathlib import Path

from fem_check.sweeps import run
from linear_theory import SheetcrawlError
from tests.sweeps import sweep_cases


def main(file: str, means: str, scenes: str) -> None:
    """Begin it, or go on."""
    address = means if means.startswith("tcp") else None
    workers = None if address else int(means)
    try:
        run(
            *(sweep_cases.plan(int(scenes)), Path(file)),
            workers=workers,
            scheduler=address,
            answering=sweep_cases.logged,
        )
    except SheetcrawlError as problem:
        sys.exit(str(problem))


if __name__ == "__main__":
    main(*sys.argv[1:])
