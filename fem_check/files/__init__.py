"""Scene files: scenes as text in TOML, with units."""
