"""What is asked: a scene and the checks of its parts."""
