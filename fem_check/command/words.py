"""Command-line arguments, rewritten from the typed form to the one that the parser accepts."""

from collections.abc import Sequence
from difflib import get_close_matches

COMMANDS = (
    *("speed", "run", "show", "movie", "plot", "paraview", "sweep", "optimise"),
    *("new", "check", "schema", "explore", "examples"),
)

OWN = ("--help", "--version", "--install-completion")
"""Options of the program itself; any other option without a command implies `speed`."""


def tidied(arguments: Sequence[str]) -> list[str]:
    """Arguments with the command first, each option once (the last one wins), negative values attached.

    Raises ValueError for an unknown command.

    >>> from fem_check.command.words import tidied
    >>> tidied(["--alpha", "0.1", "--sine", "1", "-0.2", "--alpha", "-1e-3"])
    ['speed', '--sine', '1', '-0.2', '--alpha=-1e-3']
    """
    words = list(arguments)
    if words and words[0].startswith("--") and words[0].split("=")[0] not in OWN:
        words.insert(0, "speed")
    if words and not words[0].startswith("-") and words[0] not in COMMANDS:
        near = get_close_matches(words[0], COMMANDS, n=1)
        meant = f"; did you mean {near[0]}?" if near else f": must be {_listed(COMMANDS)}"
        raise ValueError(f"{words[0]!r} is not a command{meant}")
    groups: list[list[str]] = [[]]
    for word in words:
        if word.startswith("--"):
            groups.append([])
        groups[-1].append(word)
    last = {_name(group): group for group in groups}  # a repeated name replaces the earlier one
    return [word for name in _by_last(groups) for word in _attached(last[name])]


def _listed(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} or {names[-1]}"


def _by_last(groups: list[list[str]]) -> list[str]:
    """The groups in the order of their last use."""
    names = [_name(group) for group in groups]
    return [name for i, name in enumerate(names) if name not in names[i + 1 :]]


def _name(group: list[str]) -> str:
    return group[0].split("=")[0] if group and group[0].startswith("--") else ""


def _attached(group: list[str]) -> list[str]:
    """An option with its value, joined by = if the value looks like an option: `-5 mm`."""
    if len(group) == 2 and group[0].startswith("--") and group[1].startswith("-"):
        return [f"{group[0]}={group[1]}"]
    return group
