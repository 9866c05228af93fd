"""Gradients of the speed and of the cost of transport of sheets that bend on their ground."""
