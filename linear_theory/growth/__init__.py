"""How growth changes the sheet: the law of its stretch, its couplings, and those of a bilayer."""
