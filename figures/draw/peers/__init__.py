"""Codes for soft bodies side by side: the figure, the page."""
