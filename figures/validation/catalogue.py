"""All comparisons, grouped by subject."""

from collections.abc import Mapping

from figures.validation import crawlers, excitable, ground, growing, plane_stress, plates, shells
from figures.validation.comparison import Comparison

SUBJECTS: Mapping[str, tuple[Comparison, ...]] = {
    "Crawlers in one dimension": crawlers.COMPARISONS,
    "Sheets on the ground": ground.COMPARISONS,
    "Growing sheets": growing.COMPARISONS,
    "Excitable waves": excitable.COMPARISONS,
    "Large deflections of shells": shells.COMPARISONS,
    "Plates": plates.COMPARISONS,
    "Plane stress": plane_stress.COMPARISONS,
}
"""Headings of the page and what stands under them."""

COMPARISONS: Mapping[str, Comparison] = {
    comparison.name: comparison for group in SUBJECTS.values() for comparison in group
}
"""By name."""
