"""`python -m fem_check` is the command `sheetcrawl`."""

from fem_check.command import main

if __name__ == "__main__":
    main()
