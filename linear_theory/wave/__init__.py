"""Waves of growth, travelling or given, and what drives a body: a wave on it (`protocol.Drive`)."""
