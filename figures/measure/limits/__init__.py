"""How far claims of validity hold: of the model error, and of what counts as weak friction."""
