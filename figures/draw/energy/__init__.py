"""The figure on energy: what a wave and a breath cost."""
