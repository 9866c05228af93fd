"""The sheet: a rectangle of a homogeneous material."""
