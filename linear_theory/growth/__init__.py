"""Growth of the sheet: the law of the stretch, the growth couplings, and those of a bilayer."""
