"""The appendix of the write-up: formulas that sympy proves before they are printed.

    python -m paper.derive [--out FILE]

Writes paper/generated/derivations.json: half a minute. A formula is printed as it is stated if its
difference to what is derived vanishes, and `ProofError` is raised if not. What the tests derive
(`tests/test_derivations_*.py`) is taken from there: appendix and tests cannot say different things.
"""

from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from figures.common import output
from figures.common.command import parser
from paper.derive import excitable as proofs_excitable
from paper.derive import limits as proofs_limits
from paper.derive import line as proofs_line
from paper.derive import plate as proofs_plate
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
    proofs_plate.quantile,
    proofs_plate.directional_sine,
    proofs_plate.ground_and_plate,
    proofs_plate.mixed_order,
    proofs_plate.lower_face,
    proofs_plate.power,
    proofs_limits.limits,
    proofs_excitable.oscillation,
)


def compute(steps: Sequence[Callable[[], Step]] = STEPS) -> list[Step]:
    """Prove and write down. Raises ProofError."""
    return [step() for step in output.tracked("derivations", steps)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Prove all steps and write the appendix."""
    options = parser("python -m paper.derive", __doc__, PATH).parse_args(arguments)
    print(output.write_json(options.out, {"steps": [asdict(step) for step in compute()]}))
