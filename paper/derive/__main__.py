"""`python -m paper.derive` proves and writes the appendix."""

from paper.derive.appendix import main

if __name__ == "__main__":
    main()
