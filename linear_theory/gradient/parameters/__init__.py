"""The parameters of a scene with respect to which there are derivatives."""
