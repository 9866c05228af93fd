"""The motion of the points of a sheet, in the form read by the friction balance."""
