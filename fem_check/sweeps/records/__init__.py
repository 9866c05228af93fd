"""What a sweep keeps: records in a file, and what is read from it."""
