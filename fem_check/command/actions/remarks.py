"""Warnings of a computation, as the command tells them."""

import sys
from collections.abc import Iterable
from warnings import WarningMessage


def tell(seen: Iterable[WarningMessage]) -> None:
    """One line each on stderr; deprecations are between libraries and say nothing of the answer."""
    for warning in seen:
        if not issubclass(warning.category, DeprecationWarning | PendingDeprecationWarning):
            print(f"sheetcrawl: warning: {warning.message}", file=sys.stderr)
