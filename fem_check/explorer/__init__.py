"""`sheetcrawl explore`: a local page with sliders.

What small strain answers is drawn at once: the deformed sheet with its friction, V(alpha) and the cost.
The nonlinear answer of `predict` follows from a second process, in which a newer question replaces an
older one. `question`, `small_strain`, `nonlinear` and `text` do not need the framework of the page.
"""
