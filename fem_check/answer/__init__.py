"""Answers for people: numbers with errors, units and their meaning, in a dozen lines."""
