"""`python -m figures.draw.energy` draws the figure on energy."""

from figures.draw.energy.figure import main

if __name__ == "__main__":
    main()
