"""Waves that the strain of the sheet acts back on, advanced together with it."""
