"""Error against time of every level of the theory, and the price of each effect."""
