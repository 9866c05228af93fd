"""Scripts that compute or measure: the tables of figures/data, and benchmarks that are printed."""
