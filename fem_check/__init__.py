"""Finite elements that check the linear theory across alpha."""
