"""The appendix of the write-up: formulas that are proved before they are printed."""
