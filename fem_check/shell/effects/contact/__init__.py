"""Contact of the sheet with itself: the effect, its barrier, and forces between distant parts."""
