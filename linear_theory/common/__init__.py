"""What every part uses: checks of input, errors, how results show themselves, progress, threads."""
