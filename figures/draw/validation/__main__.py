"""`python -m figures.draw.validation` draws the figure on the numbers of others."""

from figures.draw.validation.figure import main

if __name__ == "__main__":
    main()
