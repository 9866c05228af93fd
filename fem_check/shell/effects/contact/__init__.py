"""Contact of the sheet with itself: the effect, its barrier, and what distant parts do to each other."""
