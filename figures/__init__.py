"""Scripts that make the figures; run as modules, `python -m figures.fig3`."""
