"""The appendix of the write-up: formulas that sympy proves before they are printed.

    python -m paper.derive [--out FILE]

Writes paper/generated/derivations.json: half a minute. A formula is printed as it is stated if its
difference to what is derived vanishes, and `ProofError` is raised if not. What the tests derive
(`tests/test_derivations_*.py`) is taken from there: appendix and tests cannot say different things.
"""

import argparse
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from figures.common import output
from paper.derive import line as proofs_line
from paper.derive import sheet as proofs_sheet
from paper.derive.proof import Step

PATH = Path(__file__).parents[1] / "generated" / "derivations.json"

STEPS = (
    proofs_line.velocity,
    proofs_line.balance,
    proofs_line.series,
    proofs_line.viscous,
    proofs_line.laws,
    proofs_line.first_order,
    proofs_sheet.plane_stress,
    proofs_sheet.edges,
    proofs_sheet.terms,
    proofs_sheet.wave_coefficients,
    proofs_sheet.couplings,
    proofs_sheet.tails,
    proofs_sheet.strip_limit,
    proofs_sheet.second_source,
    proofs_line.convexity,
)


def compute(steps: Sequence[Callable[[], Step]] = STEPS) -> list[Step]:
    """Prove and write down. Raises ProofError."""
    done = []
    with output.Progress("derivations", len(steps)) as progress:
        for step in steps:
            done.append(step())
            progress.advance()
    return done


def main(arguments: Sequence[str] | None = None) -> None:
    """Prove all steps and write the appendix."""
    parser = argparse.ArgumentParser(prog="paper.derive", description=main.__doc__)
    parser.add_argument("--out", type=Path, default=PATH, metavar="FILE")
    options = parser.parse_args(arguments)
    print(output.write_json(options.out, {"steps": [asdict(step) for step in compute()]}))


if __name__ == "__main__":
    main()
