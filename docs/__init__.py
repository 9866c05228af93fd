"""Pages of the documentation, and `docs.site`, which makes them one site."""
