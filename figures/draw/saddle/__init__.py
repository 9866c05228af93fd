"""The saddle of V over growth and curvature: its figure, its page."""
