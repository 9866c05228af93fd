"""Scripts that draw: a module or folder for each figure, and the film of the README."""
