"""What acts on a sheet, one file per effect; a scene names those that it calls for."""
