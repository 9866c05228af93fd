"""The gradient of the speed against central differences, and what it costs."""
