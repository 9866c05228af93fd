"""Answers for people: numbers with their errors and units, and what they mean, in a dozen lines."""
