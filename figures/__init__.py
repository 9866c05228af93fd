"""What is measured, and the figures drawn of it; run as modules, `python -m figures.draw.fig3`."""
