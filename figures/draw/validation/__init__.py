"""The figure of the numbers that others published: `python -m figures.draw.validation`."""
