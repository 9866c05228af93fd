"""Other finite element codes, for comparison where they are installed."""
