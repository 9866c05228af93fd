"""Run as a program; see `docs.site.build`."""

from docs.site.build import main

if __name__ == "__main__":
    main()
