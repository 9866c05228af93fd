"""The write-up: its text, the numbers and derivations that it shows, and the program that sets it."""
