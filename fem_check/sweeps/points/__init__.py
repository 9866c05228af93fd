"""Which scenes a sweep has: fields, what they may be, and designs."""
