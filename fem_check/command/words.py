"""The words of the command line, as they are typed and as the parser takes them."""

from collections.abc import Sequence

COMMANDS = (
    *("speed", "run", "show", "movie", "plot", "paraview"),
    *("new", "check", "schema", "examples"),
)

OWN = ("--help", "--version", "--install-completion")
"""Options of the program itself; any other option without a command belongs to `speed`."""


def tidied(arguments: Sequence[str]) -> list[str]:
    """The words with their command, each option once (the last one counts), negative values attached.

    Raises ValueError for a command that there is not.

    >>> from fem_check.command.words import tidied
    >>> tidied(["--alpha", "0.1", "--sine", "1", "-0.2", "--alpha", "-1e-3"])
    ['speed', '--sine', '1', '-0.2', '--alpha=-1e-3']
    """
    words = list(arguments)
    if words and words[0].startswith("--") and words[0].split("=")[0] not in OWN:
        words.insert(0, "speed")
    if words and not words[0].startswith("-") and words[0] not in COMMANDS:
        raise ValueError(f"{words[0]!r} is not a command; there are {_listed(COMMANDS)}")
    groups: list[list[str]] = [[]]
    for word in words:
        if word.startswith("--"):
            groups.append([])
        groups[-1].append(word)
    last = {_name(group): group for group in groups}  # where a name comes again, it is replaced
    return [word for name in _by_last(groups) for word in _attached(last[name])]


def _listed(names: Sequence[str]) -> str:
    return f"{', '.join(names[:-1])} and {names[-1]}"


def _by_last(groups: list[list[str]]) -> list[str]:
    """The names in the order of their last use."""
    names = [_name(group) for group in groups]
    return [name for i, name in enumerate(names) if name not in names[i + 1 :]]


def _name(group: list[str]) -> str:
    return group[0].split("=")[0] if group and group[0].startswith("--") else ""


def _attached(group: list[str]) -> list[str]:
    """An option with its value, joined where the value could be taken for an option: `-5 mm`."""
    if len(group) == 2 and group[0].startswith("--") and group[1].startswith("-"):
        return [f"{group[0]}={group[1]}"]
    return group
