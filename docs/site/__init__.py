"""The documentation as one site: pages, examples as they run, and the API; `make docs`."""
