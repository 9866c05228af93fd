"""Waves of growth, travelling or general, and waves on a body (`protocol.Drive`)."""
