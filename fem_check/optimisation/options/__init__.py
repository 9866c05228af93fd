"""What an optimisation may be asked for besides an objective: constraints, and several regimes."""
