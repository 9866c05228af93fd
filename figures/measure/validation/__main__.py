"""python -m figures.measure.validation."""

from figures.measure.validation import main

main()
