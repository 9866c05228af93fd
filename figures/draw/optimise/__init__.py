"""The figure of best waves, and the page on what optimisation buys."""
