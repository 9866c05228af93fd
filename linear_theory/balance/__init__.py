"""The friction balance, at one time and over a period."""
