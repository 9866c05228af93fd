"""What all scripts share: files and tables, options, the look, the sheets that are simulated."""
