"""The effects on a sheet, one file each; a scene names those that act."""
