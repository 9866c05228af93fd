"""Results that others published, each with the function that computes it here: docs/validation.md.

A `Comparison` belongs to one subject and has one module per subject: `crawlers`, `ground`, `growing`,
`excitable`, `shells`, `plates` and `plane_stress`; `catalogue` lists all. `figures.measure.validation`
computes the table, `page` draws the page.
"""
