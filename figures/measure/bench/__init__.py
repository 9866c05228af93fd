"""Benchmarks that are printed and kept nowhere."""
