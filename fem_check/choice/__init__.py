"""The levels of theory, and the choice of the cheapest that meets a tolerance."""
