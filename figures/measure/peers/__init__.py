"""Two scenes on the ground by this package and by codes for soft bodies that install as wheels."""
