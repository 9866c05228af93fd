"""`python -m figures.measure.peers` measures."""

from figures.measure.peers.command import main

if __name__ == "__main__":
    main()
