"""`python -m paper.numbers` computes all numbers."""

from paper.numbers.groups import main

if __name__ == "__main__":
    main()
