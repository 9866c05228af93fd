"""The balance of friction, at one time and through a period."""
