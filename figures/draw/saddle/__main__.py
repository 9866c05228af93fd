"""`python -m figures.draw.saddle` draws the figure."""

from figures.draw.saddle.figure import main

if __name__ == "__main__":
    main()
