"""Exit statuses of the program."""

MET, MISSED, BAD_ARGUMENTS = 0, 1, 2
INTERRUPTED, CLOSED_PIPE, TERMINATED = 130, 141, 143
"""As shells report a program that SIGINT, SIGPIPE or SIGTERM has ended."""
