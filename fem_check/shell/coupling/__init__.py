"""Strains of the sheet that act back on its wave."""
