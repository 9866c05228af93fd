"""The command: python -m figures.measure.gradient."""

from figures.measure.gradient.table import main

if __name__ == "__main__":
    main()
