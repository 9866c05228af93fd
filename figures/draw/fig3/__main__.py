"""`python -m figures.draw.fig3` draws the figure."""

from figures.draw.fig3.figure import main

if __name__ == "__main__":
    main()
