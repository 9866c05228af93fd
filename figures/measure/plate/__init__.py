"""Sheets that bend on their ground: how far the form of V holds, what the lower face adds."""
