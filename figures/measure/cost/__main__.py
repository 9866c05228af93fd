"""`python -m figures.measure.cost` measures."""

from figures.measure.cost.command import main

if __name__ == "__main__":
    main()
