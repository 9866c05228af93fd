"""Best waves of a body on a line: suprema that can be written down, and the gradient of the speed."""
