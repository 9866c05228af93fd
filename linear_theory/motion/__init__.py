"""The motion of the points of a sheet as the balance of friction reads it."""
