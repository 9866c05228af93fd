"""The parts of a scene, each made of its tables."""
