"""See the package."""

from figures.measure.naghdi import main

if __name__ == "__main__":
    main()
