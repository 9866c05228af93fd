"""`python -m figures.draw.peers` draws the figure."""

from figures.draw.peers.figure import main

if __name__ == "__main__":
    main()
