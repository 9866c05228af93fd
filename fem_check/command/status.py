"""Exit statuses of the program."""

MET, MISSED, BAD_ARGUMENTS = 0, 1, 2
INTERRUPTED, CLOSED_PIPE = 130, 141
"""As shells report a program that SIGINT or SIGPIPE has ended."""
