"""The scene, which states the problem, and the checks of its parts."""
