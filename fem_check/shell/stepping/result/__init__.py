"""What a simulated motion says: shapes between kept states, mean speeds and their errors, its path."""
